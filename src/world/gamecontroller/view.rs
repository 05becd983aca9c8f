//! What a control packet says about our match. A side is 0 for home and 1 for away, the place in arrays of two.

use std::collections::BTreeSet;
use std::fmt;

use super::control::{ControlPacket, GamePhase, Penalty, SetPlay, State};
use crate::ids::{RobotId, Team};

/// Seconds after which a box that has finished a match is taken to be done with it: one with a winner, and one that may go
/// on with extra time, a shoot-out or the next shot of one. ASSUMPTION: the breaks of the league's rules are shorter.
const DONE_AFTER: (f64, f64) = (20.0, 300.0);
/// Seconds of silence after which a box that has finished a match is taken to be done with it. ASSUMPTION.
pub const GONE_AFTER: f64 = 5.0;

/// What a control packet says about our match.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoxView {
    /// The state of the game.
    pub state: State,
    /// The phase of the game.
    pub game_phase: GamePhase,
    /// The set play that runs.
    pub set_play: SetPlay,
    /// Whether play is stopped, from version 19 on.
    pub stopped: bool,
    /// Also in the first half of extra time.
    pub first_half: bool,
    /// The side that defends the left goal now.
    pub left: usize,
    /// The side that has the kick-off or the set play. None at a dropped ball.
    pub kicking: Option<usize>,
    /// Goals by side.
    pub score: [u32; 2],
    /// Seconds left in the half; negative when it has run over.
    pub seconds_left: i16,
    /// Seconds on the second clock: what is left of `Ready`, of a set play, of a time-out.
    pub secondary_time: i16,
    /// The players of ours that are penalised or substitutes, by side, in the order of their numbers.
    pub penalties: [Vec<Penalised>; 2],
    /// Players that take part for the box and do not exist here, by side, counted from 0.
    pub missing: [Vec<u8>; 2],
}

impl Default for BoxView {
    /// A match that has not begun.
    fn default() -> BoxView {
        BoxView {
            state: State::Initial,
            game_phase: GamePhase::Normal,
            set_play: SetPlay::None,
            stopped: false,
            first_half: true,
            left: 0,
            kicking: None,
            score: [0, 0],
            seconds_left: 0,
            secondary_time: 0,
            penalties: Default::default(),
            missing: Default::default(),
        }
    }
}

/// A player that may not play.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Penalised {
    /// Counted from 0.
    pub player: u8,
    /// Not [`Penalty::None`].
    pub penalty: Penalty,
    /// The box's estimate. A penalty may outlast it, as the referee ends it.
    pub seconds_left: u8,
}

/// What nobody here can do, since no version that we know says what it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NotObeyed {
    /// A state of the game.
    State(State),
    /// A phase of the game.
    GamePhase(GamePhase),
    /// A set play.
    SetPlay(SetPlay),
    /// It is served off the pitch.
    Penalty(Penalty),
    /// A set play that is for neither of the teams.
    NobodyKicks(SetPlay),
}

impl BoxView {
    /// What a packet says of teams with so many players each that stand at these places in it, home first.
    pub(super) fn of(packet: &ControlPacket, places: [usize; 2], players: [u8; 2]) -> BoxView {
        let teams = places.map(|place| &packet.teams[place]);
        let sides =
            [0, 1].map(|side| (0u8..).zip(teams[side].players).map(move |it| (it, it.0 < players[side])));
        let penalties = sides.clone().map(|side| {
            let ours = side.filter(|((_, info), exists)| *exists && info.penalty != Penalty::None);
            let penalised = ours.map(|((player, info), _)| Penalised {
                player,
                penalty: info.penalty,
                seconds_left: info.secs_till_unpenalised,
            });
            penalised.collect()
        });
        let missing = sides.map(|side| {
            let others = side.filter(|((_, info), exists)| !exists && info.penalty != Penalty::Substitute);
            others.map(|((player, _), _)| player).collect()
        });
        let numbers = teams.map(|team| team.team_number);
        BoxView {
            state: packet.state,
            game_phase: packet.game_phase,
            set_play: packet.set_play,
            stopped: packet.stopped.is_set(),
            first_half: packet.first_half.is_set(),
            left: usize::from(places[0] != 0),
            kicking: numbers.iter().position(|number| packet.kicking_team == Some(*number)),
            score: teams.map(|team| u32::from(team.score)),
            seconds_left: packet.secs_remaining,
            secondary_time: packet.secondary_time,
            penalties,
            missing,
        }
    }

    /// Seconds of this state after which the box is taken to be done with the match, if it may be: a half may be followed
    /// by another, and a match without a winner goes on after a break.
    pub fn done_after(&self) -> Option<f64> {
        let decided = self.score[0] != self.score[1] && self.game_phase != GamePhase::PenaltyShootOut;
        let may_be_over = self.state == State::Finished && !self.first_half;
        may_be_over.then_some(if decided { DONE_AFTER.0 } else { DONE_AFTER.1 })
    }

    /// Whether one robot has the ball and only the opposing goalkeeper is in its way.
    pub fn is_penalty_kick(&self) -> bool {
        self.set_play == SetPlay::PenaltyKick || self.game_phase == GamePhase::PenaltyShootOut
    }

    /// The team that has the kick-off or the set play. None at a dropped ball.
    pub fn kicking_team(&self) -> Option<Team> {
        self.kicking.and_then(|side| Team::BOTH.get(side)).copied()
    }

    /// The penalty of a player.
    pub fn penalty_of(&self, side: usize, player: u8) -> Penalty {
        let found = self.penalties[side].iter().find(|penalised| penalised.player == player);
        found.map_or(Penalty::None, |penalised| penalised.penalty)
    }

    /// Each robot whose penalty is another one than before, with the one that it has now.
    pub fn new_penalties(&self, before: Option<&BoxView>) -> Vec<(RobotId, Penalty)> {
        let mut changed = Vec::new();
        for team in Team::BOTH {
            let side = team.index();
            let known = before.into_iter().chain([self]).flat_map(|view| &view.penalties[side]);
            let players: BTreeSet<u8> = known.map(|penalised| penalised.player).collect();
            for player in players {
                let was = before.map_or(Penalty::None, |view| view.penalty_of(side, player));
                let is = self.penalty_of(side, player);
                if was != is {
                    changed.push((RobotId::new(team, player), is));
                }
            }
        }
        changed
    }

    /// What cannot be obeyed of this.
    pub fn not_obeyed(&self) -> Vec<NotObeyed> {
        let mut found = Vec::new();
        if let State::Other(_) = self.state {
            found.push(NotObeyed::State(self.state));
        }
        if let GamePhase::Other(_) = self.game_phase {
            found.push(NotObeyed::GamePhase(self.game_phase));
        }
        match self.set_play {
            SetPlay::Other(_) => found.push(NotObeyed::SetPlay(self.set_play)),
            SetPlay::None => {}
            _ if self.kicking.is_none() => found.push(NotObeyed::NobodyKicks(self.set_play)),
            _ => {}
        }
        for penalised in self.penalties.iter().flatten() {
            if let Penalty::Other(_) = penalised.penalty {
                found.push(NotObeyed::Penalty(penalised.penalty));
            }
        }
        found
    }
}

impl fmt::Display for NotObeyed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotObeyed::State(state) => write!(f, "the state \"{state}\" is unknown: the one before goes on"),
            NotObeyed::GamePhase(phase) => {
                write!(f, "the phase \"{phase}\" is unknown: taken for normal play")
            }
            NotObeyed::SetPlay(play) => write!(f, "the set play \"{play}\" is unknown: both teams play on"),
            NotObeyed::Penalty(penalty) => {
                write!(f, "the penalty \"{penalty}\" is unknown: served off the pitch")
            }
            NotObeyed::NobodyKicks(play) => write!(f, "a {play} for neither team: both play on"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::control::tests::HSL_INITIAL;
    use super::*;

    fn view() -> BoxView {
        BoxView::of(&ControlPacket::read(HSL_INITIAL).unwrap(), [0, 1], [4, 4])
    }

    #[test]
    fn a_match_may_be_over_when_its_second_half_is_and_sooner_if_there_is_a_winner() {
        let finished = BoxView { state: State::Finished, first_half: false, score: [1, 0], ..view() };
        assert_eq!(finished.done_after(), Some(20.0));
        assert_eq!(BoxView { score: [1, 1], ..finished.clone() }.done_after(), Some(300.0));
        let shots = BoxView { game_phase: GamePhase::PenaltyShootOut, ..finished.clone() };
        assert_eq!(shots.done_after(), Some(300.0), "the next shot comes");
        let extra = BoxView { game_phase: GamePhase::ExtraTime, ..finished.clone() };
        assert_eq!(extra.done_after(), Some(20.0));
        assert_eq!(BoxView { first_half: true, ..extra }.done_after(), None);
        assert_eq!(BoxView { state: State::Playing, ..finished }.done_after(), None);
    }

    #[test]
    fn players_who_take_part_for_the_box_and_not_here_are_named() {
        assert_eq!(view().missing, [vec![4, 5, 6], vec![4, 5, 6]], "its others are substitutes");
        let packet = ControlPacket::read(HSL_INITIAL).unwrap();
        assert_eq!(BoxView::of(&packet, [0, 1], [7, 3]).missing, [vec![], vec![3, 4, 5, 6]]);
    }

    #[test]
    fn what_is_unknown_is_not_obeyed_and_says_so() {
        assert_eq!(view().not_obeyed(), []);
        let penalised = Penalised { player: 1, penalty: Penalty::Other(99), seconds_left: 0 };
        let odd = BoxView {
            state: State::Other(9),
            game_phase: GamePhase::Other(7),
            set_play: SetPlay::Other(8),
            penalties: [vec![], vec![penalised]],
            ..view()
        };
        let said: Vec<String> = odd.not_obeyed().iter().map(NotObeyed::to_string).collect();
        assert_eq!(
            said,
            [
                "the state \"code 9\" is unknown: the one before goes on",
                "the phase \"code 7\" is unknown: taken for normal play",
                "the set play \"code 8\" is unknown: both teams play on",
                "the penalty \"code 99\" is unknown: served off the pitch",
            ]
        );
        let nobodys = BoxView { set_play: SetPlay::CornerKick, kicking: None, ..view() };
        assert_eq!(nobodys.not_obeyed()[0].to_string(), "a corner kick for neither team: both play on");
    }
}
