//! Whether each role has somebody who plays it.

use serde::Serialize;

use super::play_tick::PlayTick;
use super::span::Span;
use crate::ids::Team;

/// For how long roles were played by fewer or more robots than at the kick-off. A robot that is off or serves a penalty plays none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RoleCover {
    /// A role of the kick-off was played by nobody.
    pub vacant: Span,
    /// A role was played by more robots than at the kick-off.
    pub doubled: Span,
}

impl RoleCover {
    /// `at_kick_off` has the indices of the roles of all players.
    pub(super) fn update(&mut self, team: Team, at_kick_off: &[usize], tick: &PlayTick) {
        let playing = || tick.of(team).filter(|player| player.plays).map(|player| player.role);
        let held = |role: usize| playing().filter(|other| *other == role).count();
        let wanted = |role: usize| at_kick_off.iter().filter(|other| **other == role).count();
        self.vacant.update(at_kick_off.iter().any(|role| held(*role) == 0), tick.dt);
        self.doubled.update(playing().any(|role| held(role) > wanted(role)), tick.dt);
    }

    /// Play is interrupted.
    pub(super) fn interrupt(&mut self) {
        self.vacant.update(false, 0.0);
        self.doubled.update(false, 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::super::play_tick::stage::*;
    use super::super::play_tick::{PlayTick, PlayerTick};
    use super::*;

    /// Tenths of a second in which a role was vacant, and in which one was doubled, after one tick with these two robots.
    fn after(roles: [usize; 2], plays: bool) -> [f64; 2] {
        let one = PlayerTick { role: roles[0], ..player(HOME_1, 0.0, 0.0) };
        let other = PlayerTick { role: roles[1], plays, ..player(HOME_2, 0.0, 0.0) };
        let tick: PlayTick = tick(&[one, other]);
        let mut cover = RoleCover::default();
        cover.update(Team::Home, &[1, 2], &tick);
        [cover.vacant, cover.doubled].map(|span| (span.total * 10.0).round())
    }

    #[test]
    fn each_role_has_its_robot_or_is_vacant_or_doubled() {
        assert_eq!(after([1, 2], true), [0.0, 0.0]);
        assert_eq!(after([2, 1], true), [0.0, 0.0], "swapped");
        assert_eq!(after([2, 2], true), [1.0, 1.0]);
        assert_eq!(after([1, 2], false), [1.0, 0.0], "one is off");
        assert_eq!(after([1, 3], true), [1.0, 1.0], "a role that nobody had");
    }

    #[test]
    fn a_role_that_two_have_from_the_start_is_not_doubled_by_them() {
        let mut cover = RoleCover::default();
        cover.update(Team::Home, &[0, 0], &tick(&[player(HOME_1, 0.0, 0.0), player(HOME_2, 1.0, 0.0)]));
        assert_eq!(cover, RoleCover::default());
    }
}
