//! Which match the window plays, and how one begins: a [`Wish`] is read and started before the next frame.

use bevy::prelude::*;

use super::calls::Trouble;
use super::state::{Pace, Piloted, Screen, Selected};
use crate::data::{AssetFolder, DataError};
use crate::game::{Choice, MatchPlan, start_match};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Wish>()
        .init_resource::<Session>()
        .add_systems(PreUpdate, begin_wished_match.run_if(|wish: Res<Wish>| wish.0.is_some()));
}

/// Where the files are.
#[derive(Resource, Clone, Debug)]
pub struct Folder(pub AssetFolder);

/// The match that is wanted next.
#[derive(Resource, Clone, Debug, Default)]
pub struct Wish(pub Option<Choice>);

/// The match that is played.
#[derive(Resource, Clone, Debug, Default)]
pub struct Session {
    /// What it was made of.
    pub choice: Choice,
    /// What that came to; none before the first match.
    pub plan: Option<MatchPlan>,
}

/// A match has been put into the world, from its beginning.
#[derive(Event, Clone, Copy, Debug)]
pub struct MatchBegun;

/// Whether the command line has chosen a match, rather than leaving it to the menu.
pub fn is_chosen(choice: &Choice) -> bool {
    let untouched = Choice { seed: choice.seed, ..Choice::default() };
    *choice != untouched || choice.seed > DEFAULT_SEED
}

/// The seed of a match that nobody has chosen one for, as on the command line.
pub const DEFAULT_SEED: u64 = 1;

fn begin_wished_match(world: &mut World) {
    let Some(choice) = world.resource_mut::<Wish>().0.take() else { return };
    match plan_for(world, &choice) {
        Ok(plan) => begin(world, choice, plan),
        Err(error) => world.resource_mut::<Trouble>().0 = Some(error.to_string()),
    }
}

/// The plan for a choice, from the files as they are now; while they are bad, a match that was played before can be
/// played again from what was read then.
fn plan_for(world: &mut World, choice: &Choice) -> Result<MatchPlan, DataError> {
    let read = MatchPlan::read(&world.resource::<Folder>().0, choice);
    let session = world.resource::<Session>();
    let known = session.plan.clone().filter(|_| session.choice == *choice);
    match (read, known) {
        (Err(error), Some(plan)) => {
            world.resource_mut::<Trouble>().0 = Some(error.to_string());
            Ok(plan)
        }
        (read, _) => {
            world.resource_mut::<Trouble>().0 = None;
            read
        }
    }
}

fn begin(world: &mut World, choice: Choice, plan: MatchPlan) {
    start_match(world, &plan);
    world.insert_resource(Piloted(plan.pilot));
    world.insert_resource(Selected(plan.pilot));
    let speed = world.resource::<Pace>().speed;
    world.insert_resource(Pace { speed, ..Pace::default() });
    world.insert_resource(Session { choice, plan: Some(plan) });
    world.resource_mut::<NextState<Screen>>().set(Screen::Match);
    super::shown::clear(world);
    world.trigger(MatchBegun);
    world.flush();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::{RobotId, Team};

    #[test]
    fn a_command_line_without_choice_leads_to_the_menu() {
        assert!(!is_chosen(&Choice::default()));
        assert!(!is_chosen(&Choice { seed: DEFAULT_SEED, ..Choice::default() }));
    }

    #[test]
    fn a_seed_a_team_or_a_pilot_is_a_choice() {
        assert!(is_chosen(&Choice { seed: 7, ..Choice::default() }));
        assert!(is_chosen(&Choice { home: Some("ball_chasers".into()), ..Choice::default() }));
        assert!(is_chosen(&Choice { pilot: Some(RobotId::new(Team::Away, 3)), ..Choice::default() }));
    }
}
