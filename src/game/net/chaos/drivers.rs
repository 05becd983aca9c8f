//! Who drives which robot from elsewhere (TeamChaos, section 1: to teleoperate the robot, to check kicks or locomotion). A robot of
//! whose driver nothing is heard stops, and after a while its strategy takes it back.

use std::collections::BTreeMap;
use std::net::SocketAddr;

use crate::clock::Clock;
use crate::game::requests::Request;
use crate::ids::RobotId;
use crate::robot::pilot::Pilot;

/// A robot stops if nothing is heard of its driver for this time, s.
pub(super) const STOPS_AFTER: f32 = 0.5;
/// Its strategy takes it back after this time, s.
pub(super) const BACK_AFTER: f32 = 5.0;

/// The robots that are driven from elsewhere.
#[derive(Debug, Default)]
pub(super) struct Drivers(BTreeMap<RobotId, Wheel>);

/// At the wheel of one robot.
#[derive(Debug)]
struct Wheel {
    from: SocketAddr,
    heard: u64,
    stopped: bool,
}

impl Drivers {
    /// What a driver's word comes to.
    ///
    /// # Errors
    /// Says who drives the robot already.
    pub fn hear(
        &mut self,
        robot: RobotId,
        from: SocketAddr,
        pilot: Option<Pilot>,
        is_driven: bool,
        tick: u64,
    ) -> Result<Vec<Request>, String> {
        let mine = match self.0.get(&robot) {
            Some(wheel) if wheel.from != from => return Err(format!("{} drives it already", wheel.from)),
            Some(wheel) => is_driven || wheel.heard == tick,
            None if is_driven => return Err("somebody at the match drives it already".into()),
            None => false,
        };
        let Some(pilot) = pilot else {
            let was_driven = self.0.remove(&robot).is_some();
            return Ok(was_driven.then_some(Request::HandBack(robot)).into_iter().collect());
        };
        self.0.insert(robot, Wheel { from, heard: tick, stopped: false });
        let takes_over = (!mine).then_some(Request::TakeOver(robot));
        Ok(takes_over.into_iter().chain([Request::Steer { robot, pilot: pilot.limited() }]).collect())
    }

    /// What the silence of drivers comes to.
    pub fn expire(&mut self, clock: &Clock) -> Vec<Request> {
        let mut requests = Vec::new();
        self.0.retain(|robot, wheel| {
            let silent = clock.tick.saturating_sub(wheel.heard);
            if silent >= clock.ticks(BACK_AFTER) {
                requests.push(Request::HandBack(*robot));
                return false;
            }
            if silent >= clock.ticks(STOPS_AFTER) && !std::mem::replace(&mut wheel.stopped, true) {
                requests.push(Request::Steer { robot: *robot, pilot: Pilot::default() });
            }
            true
        });
        requests
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    const ROBOT: RobotId = RobotId::new(Team::Home, 1);
    const AHEAD: Pilot =
        Pilot { throttle: 1.0, aside: 0.0, turn: 0.0, head: None, kick: crate::robot::KickIntent::Nothing };

    fn at(port: u16) -> SocketAddr {
        SocketAddr::from(([127, 0, 0, 1], port))
    }

    fn clock(tick: u64) -> Clock {
        Clock { tick, ..Clock::default() }
    }

    fn steers(pilot: Pilot) -> Request {
        Request::Steer { robot: ROBOT, pilot }
    }

    #[test]
    fn a_driver_takes_a_robot_over_steers_it_and_hands_it_back() {
        let mut drivers = Drivers::default();
        let fast = Pilot { throttle: 9.0, ..AHEAD };
        let first = drivers.hear(ROBOT, at(1), Some(fast), false, 4);
        assert_eq!(first, Ok(vec![Request::TakeOver(ROBOT), steers(AHEAD)]));
        assert_eq!(drivers.hear(ROBOT, at(1), Some(AHEAD), false, 4), Ok(vec![steers(AHEAD)]));
        assert_eq!(drivers.hear(ROBOT, at(1), Some(AHEAD), true, 5), Ok(vec![steers(AHEAD)]));
        assert!(drivers.hear(ROBOT, at(2), Some(AHEAD), true, 5).is_err());
        assert_eq!(drivers.hear(ROBOT, at(1), None, true, 6), Ok(vec![Request::HandBack(ROBOT)]));
        assert_eq!(drivers.hear(ROBOT, at(1), None, false, 7), Ok(vec![]));
    }

    #[test]
    fn a_robot_that_somebody_at_the_match_drives_is_not_taken_away() {
        let mut drivers = Drivers::default();
        assert!(drivers.hear(ROBOT, at(1), Some(AHEAD), true, 0).is_err());
        assert!(drivers.hear(ROBOT, at(1), None, true, 0).is_err());
        assert_eq!(drivers.expire(&clock(1_000)), []);
    }

    #[test]
    fn a_robot_whose_driver_falls_silent_stops_once_and_is_handed_back_later() {
        let mut drivers = Drivers::default();
        drivers.hear(ROBOT, at(1), Some(AHEAD), false, 10).unwrap();
        let done: Vec<(u64, Request)> = (10..400)
            .flat_map(|tick| drivers.expire(&clock(tick)).into_iter().map(move |request| (tick, request)))
            .collect();
        assert_eq!(done, [(40, steers(Pilot::default())), (310, Request::HandBack(ROBOT))]);
    }

    #[test]
    fn who_is_heard_again_drives_on() {
        let mut drivers = Drivers::default();
        drivers.hear(ROBOT, at(1), Some(AHEAD), false, 0).unwrap();
        assert_eq!(drivers.expire(&clock(30)).len(), 1);
        assert_eq!(drivers.hear(ROBOT, at(1), Some(AHEAD), true, 31), Ok(vec![steers(AHEAD)]));
        assert_eq!(drivers.expire(&clock(60)).len(), 0);
        assert_eq!(drivers.expire(&clock(61)).len(), 1);
    }
}
