//! What is said about a referee box while it is followed, in one line each.

use std::collections::BTreeSet;
use std::net::SocketAddr;

use bevy::log::{info, warn};

use crate::clock::Clock;
use crate::world::gamecontroller::BoxNews;
use crate::world::gamecontroller::control::Penalty;
use crate::world::gamecontroller::referee_box::{BoxView, GONE_AFTER, NotObeyed, PacketCounts};

/// Remembers what has been said, so that nothing is said twice.
#[derive(Clone, Debug, Default)]
pub(super) struct BoxLog {
    /// Where the box is whose coming was told.
    sender: Option<SocketAddr>,
    said_waiting: bool,
    said_lost: bool,
    view: Option<BoxView>,
    not_obeyed: BTreeSet<NotObeyed>,
    missing: [bool; 2],
    /// The reasons for which packets were ignored that have been said.
    ignored: usize,
}

/// Seconds without a box after which a line says that it is waited for.
const SAY_WAITING_AFTER: f64 = 1.0;

impl BoxLog {
    /// Says what is new since the last look at a box that is listened for at an address. Whether the teams' numbers were given
    /// makes a difference when it comes.
    pub fn look(&mut self, news: &BoxNews, clock: &Clock, at: SocketAddr, numbers_are_given: bool) {
        match news.sender() {
            None if !self.said_waiting && clock.now() >= SAY_WAITING_AFTER => {
                self.said_waiting = true;
                match news.team_numbers() {
                    Some([home, away]) => {
                        info!("waiting for a referee box at {at} for the match of teams {home} and {away}");
                    }
                    None => info!("waiting for a referee box at {at}, for any teams"),
                }
            }
            Some((sender, _)) if news.is_lost(clock) => {
                if !std::mem::replace(&mut self.said_lost, true) {
                    warn!("the referee box at {sender} is silent: all robots stand until one is heard");
                }
            }
            _ => self.join(news, numbers_are_given),
        }
        let numbers = news.team_numbers().unwrap_or_default();
        if let Some(view) = news.view.as_ref().filter(|view| self.view.as_ref() != Some(*view)) {
            let before = self.view.replace(view.clone());
            for line in self.changes(before.as_ref(), view, numbers) {
                info!("referee box: {line}");
            }
        }
        for (from, reason) in &news.ignored()[self.ignored..] {
            warn!("a packet from {from} is ignored, as others like it will be: {reason}");
        }
        self.ignored = news.ignored().len();
    }

    /// Says who is followed, if that is news.
    fn join(&mut self, news: &BoxNews, numbers_are_given: bool) {
        let (Some((sender, version)), Some([home, away])) = (news.sender(), news.team_numbers()) else {
            return;
        };
        let is_back = std::mem::take(&mut self.said_lost);
        if self.sender.replace(sender) == Some(sender) {
            if is_back {
                info!("the referee box at {sender} is heard again");
            }
            return;
        }
        let assumed = if numbers_are_given {
            ""
        } else {
            ", taken from its first packet: --team-numbers names them the other way"
        };
        let version = version as u8;
        info!(
            "a referee box at {sender} (version {version}) referees the match: \
             home is team {home}, away team {away}{assumed}"
        );
    }

    /// What changed with a packet, for the teams of these numbers.
    fn changes(&mut self, before: Option<&BoxView>, now: &BoxView, numbers: [u8; 2]) -> Vec<String> {
        let mut lines = Vec::new();
        for (robot, penalty) in now.new_penalties(before) {
            let (team, shirt) = (numbers[robot.team.index()], robot.number + 1);
            let served = penalty.serving().map_or("may play again", |serving| serving.words());
            let reason = if penalty == Penalty::None { String::new() } else { format!(" {penalty}:") };
            lines.push(format!("{robot} (team {team}, number {shirt}):{reason} {served}"));
        }
        for (side, players) in now.missing.iter().enumerate() {
            if !players.is_empty() && !std::mem::replace(&mut self.missing[side], true) {
                let shirts: Vec<String> = players.iter().map(|player| (player + 1).to_string()).collect();
                let verb = if players.len() == 1 { "does" } else { "do" };
                let (team, shirts) = (numbers[side], shirts.join(", "));
                lines.push(format!("number {shirts} of team {team} {verb} not exist here"));
            }
        }
        let new = now.not_obeyed().into_iter().filter(|what| self.not_obeyed.insert(*what));
        lines.extend(new.map(|what| format!("not obeyed: {what}")));
        let was_done = before.is_some_and(|view| view.done_after().is_some());
        if let Some(seconds) = now.done_after().filter(|_| !was_done) {
            lines.push(format!(
                "the box has finished: the match is over in {seconds} s unless it goes on, or when it is silent for {GONE_AFTER} s"
            ));
        }
        lines
    }
}

/// The packets that were ignored, if there were any.
pub(super) fn ignored_line(heard: &PacketCounts) -> Option<String> {
    let counts = heard.ignored().into_iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(what, count)| format!("{count} {what}")).collect();
    (!counts.is_empty()).then(|| format!("packets that were ignored: {}", counts.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::gamecontroller::control::State;
    use crate::world::gamecontroller::referee_box::Penalised;

    fn view() -> BoxView {
        BoxView { state: State::Playing, first_half: false, score: [1, 0], ..BoxView::default() }
    }

    fn penalised(penalty: Penalty) -> BoxView {
        let pushed = Penalised { player: 1, penalty, seconds_left: 45 };
        BoxView { penalties: [vec![pushed], vec![]], ..view() }
    }

    #[test]
    fn a_penalty_is_told_when_it_begins_changes_and_ends() {
        let mut log = BoxLog::default();
        let mut said = |before: &BoxView, now: &BoxView| log.changes(Some(before), now, [6, 9]);
        let (free, set) = (view(), penalised(Penalty::MotionInSet));
        let first = said(&free, &set);
        assert_eq!(first, ["home 1 (team 6, number 2): motion in set: stands where it is"]);
        assert_eq!(said(&set, &set), [""; 0]);
        let pushing = said(&set, &penalised(Penalty::Pushing));
        assert_eq!(pushing, ["home 1 (team 6, number 2): pushing: is carried off"]);
        assert_eq!(said(&set, &free), ["home 1 (team 6, number 2): may play again"]);
    }

    #[test]
    fn who_is_missing_and_what_is_not_obeyed_is_told_once() {
        let mut log = BoxLog::default();
        let odd = BoxView { missing: [vec![], vec![4]], state: State::Other(9), ..view() };
        let said = log.changes(None, &odd, [6, 9]);
        assert_eq!(said[0], "number 5 of team 9 does not exist here");
        assert!(said[1].starts_with("not obeyed: the state \"code 9\""), "{said:?}");
        assert_eq!(log.changes(Some(&view()), &odd, [6, 9]).len(), 0);
    }

    #[test]
    fn that_a_match_may_be_over_is_told_when_it_is_finished_and_again_after_it_went_on() {
        let mut log = BoxLog::default();
        let finished = BoxView { state: State::Finished, ..view() };
        for _ in 0..2 {
            let said = log.changes(Some(&view()), &finished, [6, 9]);
            assert!(said.len() == 1 && said[0].contains("over in 20 s"), "{said:?}");
            assert_eq!(log.changes(Some(&finished), &finished, [6, 9]), [""; 0]);
        }
    }

    #[test]
    fn ignored_packets_are_counted_by_their_reason() {
        let heard = PacketCounts { news: 5, length: 16, sender: 1, ..PacketCounts::default() };
        let line = ignored_line(&heard).unwrap();
        assert!(line.ends_with("16 of a wrong length, 1 of another box"), "{line}");
        assert_eq!(ignored_line(&PacketCounts { news: 5, repeated: 2, ..PacketCounts::default() }), None);
    }
}
