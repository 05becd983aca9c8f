//! Orders on their way to a robot elsewhere. Of one kind only one is under way at a time, so that an old one that is sent again
//! cannot overtake a new one; what is wanted meanwhile waits, and the newest of that counts. Pure.

/// What is wanted of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderLine<T> {
    /// Sent under this number, and not answered.
    sent: Option<(u32, T)>,
    next: Option<T>,
}

impl<T> Default for OrderLine<T> {
    fn default() -> OrderLine<T> {
        OrderLine { sent: None, next: None }
    }
}

impl<T: Clone> OrderLine<T> {
    /// Wants this in the place of what waits.
    pub fn want(&mut self, value: T) {
        self.next = Some(value);
    }

    /// What is to be shown, since it is wanted and not yet in force.
    pub fn shown(&self) -> Option<&T> {
        self.next.as_ref().or(self.sent.as_ref().map(|(_, value)| value))
    }

    /// Sends what waits, if nothing is under way; `send` returns the order's number.
    pub fn send(&mut self, send: impl FnOnce(T) -> u32) {
        if self.sent.is_none()
            && let Some(value) = self.next.take()
        {
            self.sent = Some((send(value.clone()), value));
        }
    }

    /// The order that has been answered, if it is of this kind. It is not under way any more.
    pub fn answered(&mut self, number: u32) -> Option<T> {
        self.sent.take_if(|(sent, _)| *sent == number).map(|(_, value)| value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_order_is_under_way_and_the_newest_of_the_others_follows() {
        let mut line = OrderLine::default();
        let mut sent = Vec::new();
        let send = |line: &mut OrderLine<&'static str>, sent: &mut Vec<&'static str>| {
            line.send(|value| {
                sent.push(value);
                sent.len() as u32
            });
        };
        for value in ["first", "second", "third"] {
            line.want(value);
            send(&mut line, &mut sent);
        }
        assert_eq!((sent.as_slice(), line.shown()), (["first"].as_slice(), Some(&"third")));
        assert_eq!((line.answered(2), line.answered(1)), (None, Some("first")));
        send(&mut line, &mut sent);
        assert_eq!((sent.as_slice(), line.shown()), (["first", "third"].as_slice(), Some(&"third")));
        assert_eq!((line.answered(2), line.shown()), (Some("third"), None));
    }
}
