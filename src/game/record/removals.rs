//! How often the referee took robots off, by reason.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::world::referee::{Decision, RemovalReason};

/// Robots that the referee took off, home first, by reason; a reason that never came up is not there.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Removals(BTreeMap<RemovalReason, [u32; 2]>);

impl Removals {
    pub(super) fn update(&mut self, decisions: &[Decision]) {
        for decision in decisions {
            if let Decision::RobotRemoved { robot, reason } = decision {
                self.0.entry(*reason).or_default()[robot.team.index()] += 1;
            }
        }
    }

    /// How often for this reason, home first.
    pub fn count(&self, reason: RemovalReason) -> [u32; 2] {
        self.0.get(&reason).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::{RobotId, Team};

    #[test]
    fn removals_are_counted_by_reason_and_team() {
        let mut removals = Removals::default();
        let off = |team, reason| Decision::RobotRemoved { robot: RobotId::new(team, 1), reason };
        removals.update(&[off(Team::Away, RemovalReason::Pushing), Decision::HalfEnded { half: 1 }]);
        removals
            .update(&[off(Team::Away, RemovalReason::Pushing), off(Team::Home, RemovalReason::BallHolding)]);
        assert_eq!(removals.count(RemovalReason::Pushing), [0, 2]);
        assert_eq!(removals.count(RemovalReason::LeftTheField), [0, 0]);
        let json = serde_json::to_string(&removals).expect("it has text keys");
        assert_eq!(json, r#"{"ball_holding":[1,0],"pushing":[0,2]}"#);
    }
}
