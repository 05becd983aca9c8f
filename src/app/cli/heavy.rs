//! `touchline run --heavy`: each tick is played twice, and the first thing that does not repeat itself ends the run.

use super::ending::CommandError;
use crate::data::DataError;
use crate::game::Match;
use crate::game::net::NetworkPlan;

/// Whether the ticks of a match can be played twice.
///
/// # Errors
/// If it crosses sockets.
pub(super) fn check(network: &NetworkPlan) -> Result<(), DataError> {
    if network.has_sockets() {
        let message = "what crosses a socket comes once: no tick of this match can be played twice";
        return Err(DataError::new("--heavy", message));
    }
    Ok(())
}

/// Plays a tick twice.
///
/// # Errors
/// If something comes out differently.
pub(super) fn tick_twice(game: &mut Match) -> Result<(), CommandError> {
    let tick = game.clock().tick;
    let difference = match game.tick_twice() {
        Ok(None) => return Ok(()),
        Ok(Some(difference)) => difference.to_string(),
        Err(other) => other.to_string(),
    };
    Err(CommandError::NotRepeated { tick, difference })
}

#[cfg(test)]
mod tests {
    use bevy::prelude::*;

    use super::super::ending::Ending;
    use super::*;
    use crate::data::AssetFolder;
    use crate::game::{Choice, MatchPlan};
    use crate::robot::Head;
    use crate::schedule::{Tick, TickSystems};

    fn game() -> Match {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        Match::new(&MatchPlan::read(&assets, &Choice::default()).unwrap())
    }

    /// A counter that no copy of the match knows, which turns heads from its 200th turn on.
    fn count(mut ticks: Local<u32>, mut heads: Query<&mut Head>) {
        *ticks += 1;
        heads.iter_mut().filter(|_| *ticks >= 200).for_each(|mut head| head.pan = *ticks as f32);
    }

    #[test]
    fn a_tick_that_does_not_repeat_itself_ends_with_a_line_of_tick_robot_component_and_both_values() {
        let mut game = game();
        game.world_mut().schedule_scope(Tick, |_, schedule| {
            schedule.add_systems(count.in_set(TickSystems::Record));
        });
        let error = std::iter::repeat_with(|| tick_twice(&mut game)).find_map(Result::err).unwrap();
        let line = "tick 99 does not repeat itself: robot away 0's Head: `pan: 0.0,` and then `pan: 200.0,`";
        assert_eq!(error.to_string(), line);
        assert_eq!(error.tell(), Ending::Failed);
    }

    #[test]
    fn a_tick_that_is_played_twice_counts_once() {
        let (mut twice, mut once) = (game(), game());
        for _ in 0..30 {
            tick_twice(&mut twice).unwrap();
            once.tick();
        }
        assert_eq!(twice.clock().tick, 30);
        assert_eq!(twice.record().digest, once.record().digest);
    }
}
