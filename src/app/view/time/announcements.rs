//! What the referee decides becomes an announcement for three seconds.

use bevy::prelude::*;

use crate::app::view::state::{AfterTick, Announcement, FrameSystems, MatchBegun, Rewound};
use crate::clock::Clock;
use crate::world::referee::{Decision, PlacementReason, Whistles};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(|_: On<MatchBegun>, announcement: ResMut<Announcement>| forget(announcement))
        .add_observer(|_: On<Rewound>, announcement: ResMut<Announcement>| forget(announcement))
        .add_systems(AfterTick, note_decisions)
        .add_systems(Update, let_announcement_pass.in_set(FrameSystems::Picture));
}

/// How much a decision matters to a spectator; several fall at once, and one is shown.
fn weight(decision: &Decision) -> u8 {
    match decision {
        Decision::MatchFinished { .. } => 5,
        Decision::Goal { .. } => 4,
        Decision::HalfEnded { .. } | Decision::NoGoal { .. } => 3,
        Decision::RobotWarned { .. }
        | Decision::RobotRemoved { .. }
        | Decision::RobotReturned { .. }
        | Decision::Untouched { .. } => 2,
        Decision::BallPlaced { reason: PlacementReason::NoProgress, .. } => 2,
        Decision::RobotsPlaced { .. } => 1,
        Decision::BallPlaced {
            reason: PlacementReason::ThrowIn { .. } | PlacementReason::SetPlay | PlacementReason::Foul,
            ..
        } => 1,
        Decision::BallPlaced { reason: PlacementReason::KickOff, .. }
        | Decision::PhaseChanged(_)
        | Decision::RobotPlaced { .. } => 0,
    }
}

fn forget(mut announcement: ResMut<Announcement>) {
    *announcement = Announcement::default();
}

fn note_decisions(clock: Res<Clock>, whistles: Res<Whistles>, mut announcement: ResMut<Announcement>) {
    let last_tick = clock.tick.saturating_sub(1);
    let fresh = whistles.heard.iter().rev().take_while(|(tick, _)| *tick == last_tick).count();
    for (_, decision) in whistles.heard.iter().skip(whistles.heard.len() - fresh) {
        announcement.say(decision.to_string(), weight(decision));
    }
}

fn let_announcement_pass(time: Res<Time<Real>>, mut announcement: ResMut<Announcement>) {
    announcement.pass(time.delta_secs());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;
    use crate::world::referee::Phase;

    #[test]
    fn a_goal_is_not_talked_over_by_the_kick_off_that_follows() {
        let mut announcement = Announcement::default();
        for decision in [
            Decision::Goal { by: Team::Home, score: [1, 0] },
            Decision::RobotsPlaced { kick_off: Some(Team::Away) },
            Decision::PhaseChanged(Phase::Ready),
        ] {
            announcement.say(decision.to_string(), weight(&decision));
        }
        assert_eq!(announcement.text(), Some("Goal for home, 1:0"));
    }
}
