//! All breakpoints that a person has set.

use bevy::prelude::*;
use serde::{Deserialize, Serialize};

use super::breakpoint::{Breakpoint, StopAt};
use crate::ids::RobotId;

/// All breakpoints, in the order in which they were set.
#[derive(Resource, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Breakpoints(pub Vec<Breakpoint>);

impl Breakpoints {
    /// Sets one; one that is there already is switched on.
    pub fn set(&mut self, who: Option<RobotId>, at: StopAt) {
        match self.0.iter_mut().find(|known| known.who == who && known.at == at) {
            Some(known) => known.on = true,
            None => self.0.push(Breakpoint::new(who, at)),
        }
    }

    /// Removes those that are about the same, for this robot or for all.
    pub fn remove(&mut self, robot: RobotId, at: &StopAt) {
        self.0.retain(|known| !(known.at == *at && known.concerns(robot)));
    }

    /// Whether there is one of this kind for a robot, and then, whether it stops the match.
    pub fn mark(&self, robot: RobotId, is_meant: impl Fn(&StopAt) -> bool) -> Option<bool> {
        let meant = self.0.iter().filter(|known| known.concerns(robot) && is_meant(&known.at));
        meant.map(|known| known.on).reduce(|a, b| a || b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    const ONE: RobotId = RobotId::new(Team::Home, 1);
    const TWO: RobotId = RobotId::new(Team::Home, 2);

    #[test]
    fn a_breakpoint_is_set_once_seen_by_those_whom_it_concerns_and_removed() {
        let at = StopAt::Feature("stuck".into());
        let mark = |breakpoints: &Breakpoints, robot| breakpoints.mark(robot, |known| *known == at);
        let mut breakpoints = Breakpoints::default();
        assert_eq!(mark(&breakpoints, ONE), None);
        breakpoints.set(Some(ONE), at.clone());
        assert_eq!([ONE, TWO].map(|robot| mark(&breakpoints, robot)), [Some(true), None]);
        breakpoints.0[0].on = false;
        assert_eq!(mark(&breakpoints, ONE), Some(false));
        breakpoints.set(Some(ONE), at.clone());
        assert_eq!((breakpoints.0.len(), mark(&breakpoints, ONE)), (1, Some(true)));
        breakpoints.set(None, at.clone());
        assert_eq!(mark(&breakpoints, TWO), Some(true));
        breakpoints.remove(TWO, &at);
        assert_eq!([ONE, TWO].map(|robot| mark(&breakpoints, robot)), [Some(true), None]);
    }
}
