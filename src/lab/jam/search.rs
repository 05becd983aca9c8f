//! The search: sets of packets by their size, each once.

use std::convert::Infallible;

use serde::Serialize;

use crate::comms::radio::Act;
use crate::comms::tcm::DataType;
use crate::ids::RobotId;
use crate::lab::all_cores::on_all_cores;

/// What is done to a packet: the n-th, from 1, of a kind from a robot to another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interfered {
    /// The kind of message.
    pub kind: DataType,
    /// The sender.
    pub from: RobotId,
    /// The receiver.
    pub to: RobotId,
    /// Which of them.
    pub nth: u32,
    /// What happens to it.
    pub act: Act,
    /// The tick in which it is sent.
    pub sent: u64,
}

/// What a match with some packets interfered with comes to.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Jammed {
    /// The tick in which the harm was done.
    pub harmed: Option<u64>,
    /// How near it came to harm; more is nearer.
    pub severity: f64,
    /// The packets that it may be worth to interfere with next, in the order of their sending.
    pub packets: Vec<Interfered>,
}

/// How the search ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum JamEnd {
    /// These do harm, and nothing less does, if all smaller sets were tried.
    Harmed {
        /// In the order of their sending.
        packets: Vec<Interfered>,
        /// The tick in which the harm was done.
        tick: u64,
    },
    /// Nothing that was tried does.
    Unharmed,
    /// Somebody stopped it, and nothing that was tried until then does.
    Stopped,
}

/// What is known when the search is over.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct JamSearch {
    pub end: JamEnd,
    /// Matches that were played.
    pub played: usize,
    /// The largest size of which all sets were tried without harm; none if even the match itself does harm.
    pub exhausted: Option<usize>,
}

/// Tries sets of up to `budget` packets. Of each size, at most `beam` sets are led on to the next: those that came nearest to harm.
pub(super) fn search(
    budget: usize,
    beam: usize,
    play: impl Fn(&[Interfered]) -> Jammed + Sync,
    mut goes_on: impl FnMut(usize) -> bool,
) -> JamSearch {
    let whole = play(&[]);
    if let Some(tick) = whole.harmed {
        return JamSearch { end: JamEnd::Harmed { packets: Vec::new(), tick }, played: 1, exhausted: None };
    }
    let (mut played, mut exhausted, mut is_whole) = (1, 0, true);
    let mut level = vec![(Vec::new(), whole)];
    for size in 1..=budget {
        let larger = |set: &[Interfered], packet: Interfered| [set, &[packet]].concat();
        let sets =
            level.iter().flat_map(|(set, jammed)| jammed.packets.iter().map(|packet| larger(set, *packet)));
        let (mut next, mut is_stopped) = (Vec::new(), false);
        let Ok(()) = on_all_cores(
            sets.enumerate(),
            || (),
            |(), (place, set)| (place, play(&set), set),
            |tried| {
                next.push(tried);
                played += 1;
                is_stopped |= !goes_on(played);
                Ok::<_, Infallible>(!is_stopped)
            },
        );
        next.sort_unstable_by_key(|(place, ..)| *place);
        let mut next: Vec<_> = next.into_iter().map(|(_, jammed, set)| (set, jammed)).collect();
        let harmed = next.iter().filter_map(|(set, jammed)| Some((jammed.harmed?, set)));
        if let Some((tick, set)) = harmed.min_by_key(|(tick, _)| *tick) {
            let end = JamEnd::Harmed { packets: set.clone(), tick };
            return JamSearch { end, played, exhausted: Some(exhausted) };
        }
        if is_stopped {
            return JamSearch { end: JamEnd::Stopped, played, exhausted: Some(exhausted) };
        }
        exhausted = if is_whole { size } else { exhausted };
        // Equal ones stay in the order in which they were found.
        next.sort_by(|(_, a), (_, b)| b.severity.total_cmp(&a.severity));
        is_whole &= next.len() <= beam;
        next.truncate(beam);
        level = next;
    }
    JamSearch { end: JamEnd::Unharmed, played, exhausted: Some(exhausted) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Team;

    fn packet(sent: u64) -> Interfered {
        let [from, to] = [1, 2].map(|number| RobotId::new(Team::Home, number));
        Interfered { kind: DataType::LOCK, from, to, nth: sent as u32 + 1, act: Act::Drop, sent }
    }

    /// Ten packets one after the other, of which these must be lost.
    fn play(set: &[Interfered], fatal: &[u64]) -> Jammed {
        let last = set.last().map_or(0, |last| last.sent + 1);
        let lost = fatal.iter().filter(|tick| set.iter().any(|packet| packet.sent == **tick)).count();
        Jammed {
            harmed: (lost == fatal.len()).then_some(99),
            severity: lost as f64,
            packets: (last..10).map(packet).collect(),
        }
    }

    #[test]
    fn the_smallest_set_that_does_harm_is_found_and_every_set_is_tried_once() {
        let found = search(3, 1000, |set| play(set, &[2, 7]), |_| true);
        assert_eq!(found.end, JamEnd::Harmed { packets: vec![packet(2), packet(7)], tick: 99 });
        assert_eq!((found.played, found.exhausted), (1 + 10 + 45, Some(1)));
    }

    #[test]
    fn without_harm_the_size_is_told_up_to_which_all_was_tried() {
        let none = search(2, 1000, |set| play(set, &[1, 2, 3]), |_| true);
        assert_eq!((none.end, none.exhausted), (JamEnd::Unharmed, Some(2)));
        let narrow = search(3, 4, |set| play(set, &[1, 2, 8]), |_| true);
        assert!(matches!(narrow.end, JamEnd::Harmed { .. }), "what comes near is led on");
        assert_eq!(narrow.exhausted, Some(1), "of pairs only some were tried");
    }

    #[test]
    fn whether_to_go_on_is_asked_after_each_match_and_who_stops_it_gets_what_harm_was_found_by_then() {
        let stopped_at = |at: usize, fatal: &[u64]| {
            let mut asked = Vec::new();
            let found = search(
                3,
                1000,
                |set| play(set, fatal),
                |played| {
                    asked.push(played);
                    played < at
                },
            );
            assert!(asked.into_iter().eq(2..=found.played), "{found:?}");
            (found.end, found.exhausted)
        };
        assert_eq!(stopped_at(12, &[7, 8, 9]), (JamEnd::Stopped, Some(1)));
        assert_eq!(stopped_at(2, &[7, 8, 9]), (JamEnd::Stopped, Some(0)));
        assert!(matches!(stopped_at(56, &[7, 9]), (JamEnd::Harmed { .. }, Some(1))));
    }

    #[test]
    fn a_match_that_does_harm_by_itself_bears_nothing() {
        let found = search(2, 10, |set| play(set, &[]), |_| true);
        assert_eq!((found.end, found.exhausted), (JamEnd::Harmed { packets: Vec::new(), tick: 99 }, None));
    }
}
