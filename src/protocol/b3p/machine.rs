//! A robot's side of the ball booking.

use super::{
    Book, BookingInput, BookingSettings, BookingTerm, Distance, KnownBooking, OwnTick, Rules, Update,
};
use crate::ids::PlayerNumber;

/// A robot's side of the protocol: what it believes about the ball, and what it does about it.
///
/// Terms are counted up to the last one, [`BookingTerm::MAX`], and stay there. No match gets so far, but a forged or garbled message
/// may. From then on the smaller key and number count alone, an expired booking gives way to any, and a release is not heard:
/// the ball may stay with a booker that is not the nearest, but never longer than the timeout with one that is silent.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct B3p {
    me: PlayerNumber,
    settings: BookingSettings,
    booking: Option<KnownBooking>,
    /// The greatest term that this robot knows of.
    newest: BookingTerm,
    /// When this robot last announced a booking.
    announced: OwnTick,
    sees: bool,
}

impl B3p {
    /// A robot that knows of no booking.
    pub fn new(me: PlayerNumber, settings: BookingSettings) -> B3p {
        B3p { me, settings, booking: None, newest: 0, announced: 0, sees: false }
    }

    /// Takes one step and returns what the robot has to announce, if anything.
    pub fn step(&mut self, now: OwnTick, input: BookingInput) -> Option<Book> {
        match input {
            BookingInput::Turn { distance } => {
                let seen = distance.filter(|distance| !distance.is_infinite());
                self.sees = seen.is_some();
                match seen {
                    Some(distance) => self.seek(now, distance),
                    None => self.lose(now),
                }
            }
            BookingInput::Hear { from, book } => {
                if from != self.me && self.believes(now, from, &book) {
                    let Book { distance, term, key } = self.in_these_rules(book);
                    self.newest = term;
                    self.booking =
                        Some(KnownBooking { robot_booker: from, distance, timestamp: now, term, key });
                }
                None
            }
            BookingInput::Withdraw => self.withdraw(now),
        }
    }

    /// Whom the robot believes to have booked the ball, expired or not.
    pub fn booking(&self) -> Option<&KnownBooking> {
        self.booking.as_ref()
    }

    /// Whether some robot, perhaps this one, has the ball booked and has not let it go.
    pub fn is_booked(&self, now: OwnTick) -> bool {
        self.booking.is_some_and(|known| self.holds(&known, now))
    }

    /// Whether this robot goes to the ball: it is the booker and saw the ball in its last turn.
    pub fn goes(&self) -> bool {
        self.sees && self.own().is_some()
    }

    /// Whether this robot saw the ball in its last turn.
    pub fn sees(&self) -> bool {
        self.sees
    }

    /// Switches the robot off and on again: it knows nothing.
    pub fn restart(&mut self) {
        *self = B3p::new(self.me, self.settings);
    }

    /// Sets the robot's clock, which shows `now`, to `to`, and lets terms count from `term` on. The robot goes on as it would
    /// have. An age beyond all that matters is cut, so that a model checker meets finitely many robots.
    pub fn rebase(&mut self, now: OwnTick, to: OwnTick, term: BookingTerm) {
        let moved = |then: OwnTick, most: OwnTick| to.saturating_sub(now.saturating_sub(then).min(most));
        let books = self.own().is_some();
        self.announced = if books { moved(self.announced, self.settings.renewal) } else { to };
        self.newest = self.newest.saturating_sub(term);
        if let Some(known) = &mut self.booking {
            known.timestamp = moved(known.timestamp, self.settings.timeout.saturating_add(1));
            known.term = self.newest;
        }
    }

    fn own(&self) -> Option<&KnownBooking> {
        self.booking.as_ref().filter(|known| known.robot_booker == self.me)
    }

    fn has_expired(&self, known: &KnownBooking, now: OwnTick) -> bool {
        now.saturating_sub(known.timestamp) > self.settings.timeout
    }

    fn holds(&self, known: &KnownBooking, now: OwnTick) -> bool {
        !known.distance.is_infinite() && !self.has_expired(known, now)
    }

    fn counts_terms(&self) -> bool {
        matches!(self.settings.rules, Rules::Hardened { .. })
    }

    /// A turn in which the robot sees the ball.
    fn seek(&mut self, now: OwnTick, distance: Distance) -> Option<Book> {
        match self.booking {
            Some(known) if known.robot_booker != self.me && !self.may_take(now, distance, &known) => None,
            Some(own) if own.robot_booker == self.me && self.holds(&own, now) => {
                let key = if self.counts_terms() { own.key } else { distance };
                self.booking = Some(KnownBooking { distance, timestamp: now, key, ..own });
                self.renew(now)
            }
            _ => self.book(now, distance),
        }
    }

    /// A turn in which it does not. A release is repeated like any booking, until it would have expired.
    fn lose(&mut self, now: OwnTick) -> Option<Book> {
        let own = *self.own()?;
        if self.settings.rules != (Rules::Hardened { release: true }) {
            None
        } else if !own.distance.is_infinite() {
            self.book(now, Distance::INFINITE)
        } else if self.has_expired(&own, now) {
            self.booking = None;
            None
        } else {
            self.renew(now)
        }
    }

    fn withdraw(&mut self, now: OwnTick) -> Option<Book> {
        self.sees = false;
        if self.settings.rules == (Rules::Hardened { release: true }) {
            return self.lose(now);
        }
        self.own()?;
        self.booking = None;
        None
    }

    fn may_take(&self, now: OwnTick, distance: Distance, known: &KnownBooking) -> bool {
        let counts = self.newest < BookingTerm::MAX || (distance, self.me) < (known.key, known.robot_booker);
        self.has_expired(known, now) || counts && distance.is_nearer(self.settings.threshold, known.distance)
    }

    fn book(&mut self, now: OwnTick, distance: Distance) -> Option<Book> {
        if self.counts_terms() {
            self.newest = self.newest.saturating_add(1);
        }
        let (robot_booker, term) = (self.me, self.newest);
        self.booking = Some(KnownBooking { robot_booker, distance, timestamp: now, term, key: distance });
        self.announce(now)
    }

    fn renew(&mut self, now: OwnTick) -> Option<Book> {
        let due = now.saturating_sub(self.announced) >= self.settings.renewal;
        if due { self.announce(now) } else { None }
    }

    fn announce(&mut self, now: OwnTick) -> Option<Book> {
        self.announced = now;
        self.booking.map(|KnownBooking { distance, term, key, .. }| Book { distance, term, key })
    }

    fn believes(&self, now: OwnTick, from: PlayerNumber, book: &Book) -> bool {
        let Some(known) = &self.booking else { return !self.counts_terms() || book.term >= self.newest };
        let free = self.has_expired(known, now);
        let renews = from == known.robot_booker;
        match self.settings.rules {
            Rules::Paper(Update::Always) => true,
            Rules::Paper(Update::Cautious) => {
                free || renews || book.distance.is_nearer(self.settings.threshold, known.distance)
            }
            Rules::Lexicographic => {
                free || renews || (book.distance, from) < (known.distance, known.robot_booker)
            }
            Rules::Hardened { .. } => {
                let prevails = (book.key, from) <= (known.key, known.robot_booker);
                let gives_way = free && self.newest == BookingTerm::MAX;
                book.term > self.newest || book.term == self.newest && (prevails || gives_way)
            }
        }
    }

    /// Terms and keys mean nothing but under the hardened rules.
    fn in_these_rules(&self, book: Book) -> Book {
        if self.counts_terms() { book } else { Book { term: 0, key: book.distance, ..book } }
    }
}

#[cfg(test)]
mod properties;
#[cfg(test)]
mod tests;
