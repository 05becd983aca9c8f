//! What is said about a referee box while it is followed, in one line each.

use std::collections::BTreeSet;

use crate::ids::{RobotId, Team};
use crate::world::gamecontroller::control::Penalty;
use crate::world::gamecontroller::referee_box::{GONE_AFTER, Heard, NotObeyed, View};

/// Remembers what has been said, so that nothing is said twice.
#[derive(Clone, Debug, Default)]
pub(super) struct BoxLog {
    not_obeyed: BTreeSet<NotObeyed>,
    missing: [bool; 2],
}

impl BoxLog {
    /// What changed with a packet, for the teams of these numbers.
    pub fn changes(&mut self, before: Option<&View>, now: &View, numbers: [u8; 2]) -> Vec<String> {
        let mut lines = Vec::new();
        for (robot, penalty) in new_penalties(before, now) {
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

/// Each robot whose penalty is another one than before, with the one that it has now.
pub(super) fn new_penalties(before: Option<&View>, now: &View) -> Vec<(RobotId, Penalty)> {
    let mut changed = Vec::new();
    for team in Team::BOTH {
        let side = team.index();
        let known = before.into_iter().chain([now]).flat_map(|view| &view.penalties[side]);
        let players: BTreeSet<u8> = known.map(|penalised| penalised.player).collect();
        for player in players {
            let was = before.map_or(Penalty::None, |view| view.penalty_of(side, player));
            let is = now.penalty_of(side, player);
            if was != is {
                changed.push((RobotId::new(team, player), is));
            }
        }
    }
    changed
}

/// The packets that were ignored, if there were any.
pub(super) fn ignored_line(heard: &Heard) -> Option<String> {
    let counts = heard.ignored().into_iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(what, count)| format!("{count} {what}")).collect();
    (!counts.is_empty()).then(|| format!("packets that were ignored: {}", counts.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::gamecontroller::control::{GamePhase, SetPlay, State};
    use crate::world::gamecontroller::referee_box::Penalised;

    fn view() -> View {
        View {
            state: State::Playing,
            game_phase: GamePhase::Normal,
            set_play: SetPlay::None,
            stopped: false,
            first_half: false,
            left: 0,
            kicking: None,
            score: [1, 0],
            seconds_left: 5,
            secondary_time: 0,
            penalties: [vec![], vec![]],
            missing: [vec![], vec![]],
        }
    }

    fn penalised(penalty: Penalty) -> View {
        let pushed = Penalised { player: 1, penalty, seconds_left: 45 };
        View { penalties: [vec![pushed], vec![]], ..view() }
    }

    #[test]
    fn a_penalty_is_told_when_it_begins_changes_and_ends() {
        let mut log = BoxLog::default();
        let mut said = |before: &View, now: &View| log.changes(Some(before), now, [6, 9]);
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
        let odd = View { missing: [vec![], vec![4]], state: State::Other(9), ..view() };
        let said = log.changes(None, &odd, [6, 9]);
        assert_eq!(said[0], "number 5 of team 9 does not exist here");
        assert!(said[1].starts_with("not obeyed: the state \"code 9\""), "{said:?}");
        assert_eq!(log.changes(Some(&view()), &odd, [6, 9]).len(), 0);
    }

    #[test]
    fn that_a_match_may_be_over_is_told_when_it_is_finished_and_again_after_it_went_on() {
        let mut log = BoxLog::default();
        let finished = View { state: State::Finished, ..view() };
        for _ in 0..2 {
            let said = log.changes(Some(&view()), &finished, [6, 9]);
            assert!(said.len() == 1 && said[0].contains("over in 20 s"), "{said:?}");
            assert_eq!(log.changes(Some(&finished), &finished, [6, 9]), [""; 0]);
        }
    }

    #[test]
    fn ignored_packets_are_counted_by_their_reason() {
        let heard = Heard { news: 5, length: 16, sender: 1, ..Heard::default() };
        let line = ignored_line(&heard).unwrap();
        assert!(line.ends_with("16 of a wrong length, 1 of another box"), "{line}");
        assert_eq!(ignored_line(&Heard { news: 5, repeated: 2, ..Heard::default() }), None);
    }
}
