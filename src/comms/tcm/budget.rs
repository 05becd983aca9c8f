//! How many messages a team may still send, counted as the league does: each datagram once, however many robots hear it.

use std::collections::BTreeMap;

use bevy::prelude::Resource;
use serde::Serialize;

use super::data::Priority;
use crate::ids::{RobotId, Team};

/// The budgets of both teams; there are none where nobody asks how much is said.
#[derive(Resource, Clone, Debug)]
pub struct MessageBudgets {
    size: u64,
    /// What comes on top of it in extra time, until there is any.
    in_extra_time: u64,
    teams: [Spent; 2],
    /// Whether a referee box would count what is said now.
    pub counts: bool,
    /// What each robot has saved up, in messages; none where the budget does not limit what robots say.
    savings: Option<BTreeMap<RobotId, f64>>,
}

/// What a team has sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Spent {
    /// Messages that were sent and counted.
    pub counted: u64,
    /// Messages that were not sent, to keep within the budget.
    pub over_budget: u64,
}

/// The most messages that a robot saves up, so that it can answer at once and nobody floods the air.
const MOST_SAVED: f64 = 8.0;
/// What routine messages leave of it for urgent ones: enough to ask a team for its locks and to swap roles.
const RESERVE: f64 = 5.0;
/// The shortest time over which a budget is spread, s: what is left in the last moments need not be used up.
const SHORTEST: f64 = 30.0;

impl MessageBudgets {
    /// Counts what teams say, and lets them say it.
    pub fn counting(size: u64, in_extra_time: u64) -> MessageBudgets {
        MessageBudgets { size, in_extra_time, teams: [Spent::default(); 2], counts: true, savings: None }
    }

    /// Holds back from now on what these robots want to say and the budget does not bear.
    pub fn limited_to(self, robots: impl Iterator<Item = RobotId>) -> MessageBudgets {
        MessageBudgets { savings: Some(robots.map(|robot| (robot, MOST_SAVED)).collect()), ..self }
    }

    /// Messages that a team may still send.
    pub fn left(&self, team: Team) -> u64 {
        self.size.saturating_sub(self.teams[team.index()].counted)
    }

    /// Which share of all its messages a team may still send.
    pub fn share_left(&self, team: Team) -> f32 {
        self.left(team) as f32 / self.size.max(1) as f32
    }

    /// What a team has spent so far.
    pub fn spent(&self, team: Team) -> Spent {
        self.teams[team.index()]
    }

    /// There is extra time, now or before.
    pub fn begin_extra_time(&mut self) {
        self.size += std::mem::take(&mut self.in_extra_time);
    }

    /// Spreads what is left of a team's budget evenly over its robots and the `seconds_left` of the match: each robot gets
    /// its share for `dt` seconds.
    pub fn share_out(&mut self, dt: f64, seconds_left: f64) {
        let left = Team::BOTH.map(|team| self.left(team) as f64);
        let Some(savings) = &mut self.savings else { return };
        for team in Team::BOTH {
            let mates =
                |savings: &BTreeMap<RobotId, f64>| savings.keys().filter(|id| id.team == team).count();
            let share = left[team.index()] * dt / (seconds_left.max(SHORTEST) * mates(savings).max(1) as f64);
            for (_, saved) in savings.iter_mut().filter(|(id, _)| id.team == team) {
                *saved = (*saved + share).min(MOST_SAVED);
            }
        }
    }

    /// Whether a robot may send so many datagrams now; they are counted if so. More than it can ever save up it may send
    /// once it has saved the most, and pays for afterwards.
    pub fn spend(&mut self, robot: RobotId, datagrams: usize, priority: Priority) -> bool {
        if !self.counts {
            return true;
        }
        let (cost, left) = (datagrams as u64, self.left(robot.team));
        if let Some(savings) = &mut self.savings {
            let saved = savings.entry(robot).or_insert(MOST_SAVED);
            let reserve = if priority == Priority::Routine { RESERVE } else { 0.0 };
            if left < cost || *saved < (cost as f64 + reserve).min(MOST_SAVED) {
                self.teams[robot.team.index()].over_budget += cost;
                return false;
            }
            *saved -= cost as f64;
        }
        self.count(robot.team, cost);
        true
    }

    /// Counts messages that were sent elsewhere.
    pub fn count(&mut self, team: Team, messages: u64) {
        if self.counts {
            self.teams[team.index()].counted += messages;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::Priority::{Routine, Urgent};
    use super::*;

    fn robots(players: u8) -> impl Iterator<Item = RobotId> {
        Team::BOTH
            .into_iter()
            .flat_map(move |team| (0..players).map(move |number| RobotId::new(team, number)))
    }

    fn limiting(size: u64, players: u8) -> MessageBudgets {
        MessageBudgets::counting(size, 0).limited_to(robots(players))
    }

    const HOME_0: RobotId = RobotId::new(Team::Home, 0);
    const HOME_1: RobotId = RobotId::new(Team::Home, 1);

    #[test]
    fn a_budget_that_only_counts_lets_everything_be_said() {
        let mut budgets = MessageBudgets::counting(3, 6);
        assert!((0..5).all(|_| budgets.spend(HOME_0, 1, Routine)));
        assert_eq!((budgets.left(Team::Home), budgets.left(Team::Away)), (0, 3));
        assert_eq!(budgets.spent(Team::Home), Spent { counted: 5, over_budget: 0 });
        budgets.begin_extra_time();
        budgets.begin_extra_time();
        assert_eq!(budgets.left(Team::Home), 4);
    }

    #[test]
    fn what_no_box_counts_costs_nothing() {
        let mut budgets = limiting(1, 2);
        budgets.counts = false;
        assert!((0..5).all(|_| budgets.spend(HOME_0, 1, Routine)));
        budgets.count(Team::Home, 7);
        assert_eq!(budgets.left(Team::Home), 1);
        budgets.counts = true;
        assert!(budgets.spend(HOME_0, 1, Routine) && !budgets.spend(HOME_1, 1, Routine));
        assert_eq!(budgets.spent(Team::Home), Spent { counted: 1, over_budget: 1 });
    }

    #[test]
    fn robots_that_talk_without_end_share_the_budget_and_it_lasts_to_the_end() {
        for (size, seconds) in [(12_000, 1_200), (1_200, 1_200)] {
            let mut budgets = limiting(size, 4);
            let mut by_robot = BTreeMap::new();
            let mut last = 0;
            for tick in 0..seconds * 60 {
                budgets.share_out(1.0 / 60.0, f64::from(seconds * 60 - tick) / 60.0);
                for robot in robots(4) {
                    if budgets.spend(robot, 1, Routine) {
                        *by_robot.entry(robot).or_insert(0) += 1;
                        last = tick;
                    }
                }
            }
            let half = size / 8;
            assert!(by_robot.values().all(|said| (half..=size / 4 + 8).contains(said)), "{by_robot:?}");
            assert!(last > seconds * 60 - 1_200, "the last word of {size} is said in tick {last}");
            assert!(budgets.left(Team::Home) < size / 20, "{} of {size} are left", budgets.left(Team::Home));
        }
    }

    #[test]
    fn routine_messages_leave_room_for_those_of_a_protocol() {
        let mut budgets = limiting(12_000, 4);
        let chatter = |budgets: &mut MessageBudgets| {
            let second = (0..60).map(|_| {
                budgets.share_out(1.0 / 60.0, 1_200.0);
                u32::from(budgets.spend(HOME_0, 1, Routine))
            });
            second.sum::<u32>()
        };
        assert_eq!(chatter(&mut budgets), 5, "three that were saved and two of its share");
        let locks = (0..5).filter(|_| budgets.spend(HOME_0, 1, Urgent)).count();
        assert_eq!((locks, budgets.spend(HOME_0, 1, Urgent)), (5, false));
        assert_eq!(chatter(&mut budgets), 0, "the reserve is saved up again first");
    }

    #[test]
    fn a_long_message_is_sent_whole_and_paid_for_afterwards() {
        let mut budgets = limiting(1_000, 1);
        assert!(budgets.spend(HOME_0, 10, Urgent));
        budgets.share_out(1.0, 1_000.0);
        assert!(!budgets.spend(HOME_0, 1, Urgent), "it owes two and has earned one");
        budgets.share_out(3.0, 1_000.0);
        assert!(budgets.spend(HOME_0, 1, Urgent));
    }

    proptest! {
        #[test]
        fn no_team_ever_sends_more_than_its_budget(
            size in 0u64..40,
            steps in prop::collection::vec((0u8..6, 0usize..9, 0f64..50.0, -10f64..100.0), 0..200),
        ) {
            let mut budgets = limiting(size, 3);
            for (robot, cost, dt, seconds_left) in steps {
                budgets.share_out(dt, seconds_left);
                budgets.spend(RobotId::new(Team::BOTH[usize::from(robot / 3)], robot % 3), cost, Routine);
            }
            for team in Team::BOTH {
                prop_assert!(budgets.spent(team).counted <= size);
            }
        }
    }
}
