//! Who wants pictures and data of which robot, and how often. A subscription ends unless it is renewed, so there is nothing to be
//! opened or closed.

use std::net::SocketAddr;

use super::messages::Subscription;
use crate::clock::Clock;
use crate::comms::tcm::Peer;
use crate::ids::RobotId;

/// How long a subscription lasts, s.
pub(super) const SUBSCRIBED: f32 = 5.0;
/// How often a subscriber to data hears how the camera is calibrated, s.
const CALIBRATION: f32 = 1.0;
/// Subscriptions at a time.
const MOST: usize = 16;

/// The subscriptions of a match.
#[derive(Debug, Default)]
pub(super) struct Subscribers(Vec<Subscriber>);

/// Somebody who follows a robot.
#[derive(Debug)]
pub(super) struct Subscriber {
    pub robot: RobotId,
    /// Who it is, and where.
    pub at: (Peer, SocketAddr),
    until: u64,
    images: Stream,
    data: Stream,
    calibration: Stream,
    /// The tick of the picture that was sent last.
    last_image: Option<u64>,
}

/// One kind of message.
#[derive(Debug, Default)]
struct Stream {
    /// Ticks from one to the next; nothing, if it is not wanted.
    every: Option<u64>,
    due: u64,
    count: u32,
}

impl Subscribers {
    /// Begins a subscription or renews it.
    ///
    /// # Errors
    /// If there are too many.
    pub fn renew(
        &mut self,
        robot: RobotId,
        at: (Peer, SocketAddr),
        wanted: Subscription,
        clock: &Clock,
    ) -> Result<(), String> {
        self.expire(clock.tick);
        let known = self.0.iter().position(|known| (known.robot, known.at) == (robot, at));
        let place = match known {
            Some(place) => place,
            None if self.0.len() == MOST => {
                return Err(format!("{MOST} subscriptions are the most, and there are as many"));
            }
            None => {
                let (images, data) = (Stream::default(), Stream::default());
                let calibration = Stream::default();
                self.0.push(Subscriber { robot, at, until: 0, images, data, calibration, last_image: None });
                self.0.len() - 1
            }
        };
        let subscriber = &mut self.0[place];
        let every = |hz: f32| (hz > 0.0).then(|| clock.ticks(1.0 / hz));
        subscriber.until = clock.tick + clock.ticks(SUBSCRIBED);
        subscriber.images.every = every(wanted.images_hz);
        subscriber.data.every = every(wanted.data_hz);
        subscriber.calibration.every = (wanted.data_hz > 0.0).then(|| clock.ticks(CALIBRATION));
        Ok(())
    }

    /// Ends what was not renewed.
    pub fn expire(&mut self, tick: u64) {
        self.0.retain(|subscriber| tick < subscriber.until);
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Subscriber> {
        self.0.iter_mut()
    }
}

impl Subscriber {
    /// The number of the next picture, if it is due and this one, taken in a tick, was not sent yet.
    pub fn next_image(&mut self, taken: u64, tick: u64) -> Option<u32> {
        if self.last_image == Some(taken) {
            return None;
        }
        let number = self.images.next(tick)?;
        self.last_image = Some(taken);
        Some(number)
    }

    /// The number of the next data, if they are due.
    pub fn next_data(&mut self, tick: u64) -> Option<u32> {
        self.data.next(tick)
    }

    /// Whether it is to hear again how the camera is calibrated.
    pub fn hears_calibration(&mut self, tick: u64) -> bool {
        self.calibration.next(tick).is_some()
    }
}

impl Stream {
    fn next(&mut self, tick: u64) -> Option<u32> {
        let every = self.every.filter(|_| self.due <= tick)?;
        self.due = tick + every;
        self.count = self.count.wrapping_add(1);
        Some(self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    const ROBOT: RobotId = RobotId::new(Team::Home, 1);

    fn at(port: u16) -> (Peer, SocketAddr) {
        (Peer::Computer(0), SocketAddr::from(([127, 0, 0, 1], port)))
    }

    fn clock(tick: u64) -> Clock {
        Clock { tick, ..Clock::default() }
    }

    #[test]
    fn pictures_and_data_come_as_often_as_they_are_wanted_and_are_counted() {
        let mut subscribers = Subscribers::default();
        let wanted = Subscription { images_hz: 20.0, data_hz: 10.0 };
        subscribers.renew(ROBOT, at(1), wanted, &clock(7)).unwrap();
        let subscriber = subscribers.iter_mut().next().unwrap();
        // The camera takes thirty a second.
        let images: Vec<_> = (7..19).filter_map(|tick| subscriber.next_image(tick / 2, tick)).collect();
        let data: Vec<_> = (7..19).filter_map(|tick| subscriber.next_data(tick)).collect();
        assert_eq!((images, data), (vec![1, 2, 3, 4], vec![1, 2]));
        assert_eq!((7..127).filter(|tick| subscriber.hears_calibration(*tick)).count(), 2);
    }

    #[test]
    fn a_picture_is_sent_once() {
        let mut subscribers = Subscribers::default();
        let wanted = Subscription { images_hz: 60.0, data_hz: 0.0 };
        subscribers.renew(ROBOT, at(1), wanted, &clock(0)).unwrap();
        let subscriber = subscribers.iter_mut().next().unwrap();
        let sent = (0..9).filter_map(|tick| subscriber.next_image(3, tick)).count();
        assert_eq!((sent, subscriber.next_data(9)), (1, None));
    }

    #[test]
    fn a_subscription_ends_unless_it_is_renewed_and_there_are_not_too_many() {
        let mut subscribers = Subscribers::default();
        let lasts = clock(0).ticks(SUBSCRIBED);
        let wanted = Subscription { images_hz: 1.0, data_hz: 1.0 };
        for port in 0..MOST as u16 {
            subscribers.renew(ROBOT, at(port), wanted, &clock(0)).unwrap();
        }
        assert!(subscribers.renew(ROBOT, at(99), wanted, &clock(1)).is_err());
        subscribers.renew(ROBOT, at(3), wanted, &clock(9)).unwrap();
        assert_eq!(subscribers.iter_mut().count(), MOST);
        subscribers.expire(lasts);
        assert_eq!(subscribers.iter_mut().map(|one| one.at).collect::<Vec<_>>(), [at(3)]);
        subscribers.expire(lasts + 9);
        assert_eq!(subscribers.iter_mut().count(), 0);
    }
}
