//! Where a match stands: phase, score, clock, ends and who is off the field.
//!
//! Only [`super::rules`] change a [`MatchState`]; everyone else reads it. The clock stops outside [`Phase::Playing`], so a
//! half has its full playing time. (In 2001 it ran on; stopping it makes matches with many goals comparable.)

use bevy::prelude::{Resource, Vec2};

use super::decision::RemovalReason;
use super::followed::Following;
use super::phase::Phase;
use super::restraints::Restraints;
use super::rulebook::RuleBook;
use crate::geometry::Attacking;
use crate::ids::{RobotId, Team};

/// A robot that is off the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Removal {
    /// The robot.
    pub robot: RobotId,
    /// Why.
    pub reason: RemovalReason,
    /// Seconds of playing time until it may return. At 0 it waits for play to go on and for a free place.
    pub seconds_left: f64,
}

/// The state of a match between two looks of the referee.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct MatchState {
    /// The phase of the game.
    pub phase: Phase,
    /// 1 or 2.
    pub half: u8,
    /// Goals, by [`Team::index`].
    pub score: [u32; 2],
    /// Seconds of playing time left in this half; below 0 where a referee box lets it run over.
    pub time_left: f64,
    /// Who kicks off next, or kicked off last while the ball is in play.
    pub kick_off: Team,
    /// Neither team kicks off: both may go for the ball at once.
    pub dropped_ball: bool,
    /// Where home attacks; turned at half time.
    pub home_attacks: Attacking,
    /// The robot that touched the ball last since the kick-off; none while nobody can tell, since robots of both teams
    /// touched it at once.
    pub last_touch: Option<RobotId>,
    /// The robots off the field, sorted by id.
    pub removed: Vec<Removal>,
    /// Whether the rules hold; without them the ball stays in play whatever happens.
    pub refereed: bool,
    /// What a referee box forbids beyond the phase.
    pub restraints: Restraints,

    /// What is remembered of a referee box that is followed.
    pub(super) following: Following,
    /// Who kicked off the first half.
    pub(super) opened: Team,
    /// Seconds spent in `Ready` or `Set`.
    pub(super) waited: f64,
    /// Seconds of the present sample during which the ball was in play.
    pub(super) played: f64,
    /// Where the ball was at the last sample, or where the referee then put it.
    pub(super) seen_ball: Option<Vec2>,
    /// The clock of the ball's progress; none before the ball is in play.
    pub(super) anchor: Option<Anchor>,
    /// The robots in their own penalty areas, sorted by id.
    pub(super) defenders: Vec<Defender>,
    /// Seconds that all robots have stood legally and still before a kick-off; none while they do not.
    pub(super) settled: Option<f64>,
    /// What is known of the shot of the last kick-off.
    pub(super) shot: KickOffShot,
    /// Seconds of play since a robot touched the ball.
    pub(super) untouched: f64,
    /// Who holds the ball, or has just released it.
    pub(super) hold: Option<BallHold>,
    /// The robots that push others, or have just done so, sorted by id.
    pub(super) pushes: Vec<(RobotId, Streak)>,
    /// The robots that opponents have just pushed, sorted by id, and the seconds since.
    pub(super) pushed: Vec<(RobotId, f64)>,
    /// The attackers in contact with a goalkeeper, or that have just been, sorted by id.
    pub(super) on_keeper: Vec<(RobotId, Streak)>,
    /// The robots that charge opponents, or have just done so, sorted by id.
    pub(super) charges: Vec<(RobotId, Streak)>,
    /// The robots that were warned.
    pub(super) warned: Vec<RobotId>,
}

/// Whether the team that kicked off may score.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KickOffShot {
    /// The ball has not left the centre circle yet.
    InCircle,
    /// It has, and no robot of the team has touched it since.
    Left,
    /// The team may score.
    Over,
}

/// Something that a robot does for some time. A pause that is shorter than what it interrupts does not end it, and is
/// part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Streak {
    /// Seconds since it began, up to when it was last seen.
    pub seconds: f64,
    /// Seconds of the present pause.
    pub paused: f64,
}

impl Streak {
    /// Seconds of a pause that end no streak, however short it is: bodies that press on each other part for moments.
    const FLICKER: f64 = 0.2;

    /// The streak after some more seconds, none if it is over.
    pub fn after(self, seconds: f64, goes_on: bool) -> Option<Streak> {
        let paused = self.paused + seconds;
        if goes_on {
            return Some(Streak { seconds: self.seconds + paused, paused: 0.0 });
        }
        (paused < self.seconds.max(Streak::FLICKER)).then_some(Streak { paused, ..self })
    }
}

/// The streaks of robots, sorted by id, after some more seconds in which these robots went on or began.
pub(super) fn streaks_after(
    known: &[(RobotId, Streak)],
    seconds: f64,
    going_on: &[RobotId],
) -> Vec<(RobotId, Streak)> {
    let old = known
        .iter()
        .filter_map(|(robot, streak)| Some((*robot, streak.after(seconds, going_on.contains(robot))?)));
    let mut streaks: Vec<(RobotId, Streak)> = old.collect();
    for robot in going_on {
        if let Err(place) = streaks.binary_search_by_key(robot, |(robot, _)| *robot) {
            streaks.insert(place, (*robot, Streak::default()));
        }
    }
    streaks
}

/// A robot that holds the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BallHold {
    pub robot: RobotId,
    pub streak: Streak,
    /// Where the ball was when the robot last got hold of it.
    pub from: Vec2,
    /// Metres that the robot had carried it before.
    pub carried: f32,
}

/// Where the ball was when the clock of its progress started, and the seconds since.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Anchor {
    pub at: Vec2,
    pub seconds: f64,
}

/// A robot in its own penalty area and the seconds that it has been there without a break.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Defender {
    pub robot: RobotId,
    pub inside: f64,
}

impl MatchState {
    /// A match that has not begun: no goals, home attacks east.
    pub fn new(kick_off: Team, book: &RuleBook) -> MatchState {
        MatchState {
            phase: Phase::Initial,
            half: 1,
            score: [0, 0],
            time_left: book.half_seconds(),
            kick_off,
            dropped_ball: false,
            home_attacks: Attacking::East,
            last_touch: None,
            removed: Vec::new(),
            refereed: true,
            restraints: Restraints::default(),
            following: Following::default(),
            opened: kick_off,
            waited: 0.0,
            played: 0.0,
            seen_ball: None,
            anchor: None,
            defenders: Vec::new(),
            settled: None,
            shot: KickOffShot::Over,
            untouched: 0.0,
            hold: None,
            pushes: Vec::new(),
            pushed: Vec::new(),
            on_keeper: Vec::new(),
            charges: Vec::new(),
            warned: Vec::new(),
        }
    }

    /// A match that begins with the ball in play.
    pub fn in_play(kick_off: Team, book: &RuleBook, refereed: bool) -> MatchState {
        MatchState { phase: Phase::Playing, refereed, ..MatchState::new(kick_off, book) }
    }

    /// Which way a team plays in the first half.
    pub fn attacking_at_start(team: Team) -> Attacking {
        match team {
            Team::Home => Attacking::East,
            Team::Away => Attacking::West,
        }
    }

    /// Which way a team plays in this half.
    pub fn attacking(&self, team: Team) -> Attacking {
        match team {
            Team::Home => self.home_attacks,
            Team::Away => self.home_attacks.reversed(),
        }
    }

    /// Seconds of playing time since the match began.
    pub fn time_played(&self, book: &RuleBook) -> f64 {
        f64::from(self.half) * book.half_seconds() - self.time_left
    }

    /// The goals of a team.
    pub fn score_of(&self, team: Team) -> u32 {
        self.score[team.index()]
    }

    /// Seconds that robots have yet to come to their places for a kick-off, while they have any.
    pub fn ready_left(&self, book: &RuleBook) -> Option<f64> {
        (self.phase == Phase::Ready).then(|| (f64::from(book.ready_seconds) - self.waited).max(0.0))
    }

    /// Whether a team kicks off next, or kicked off last.
    pub fn kicks_off(&self, team: Team) -> bool {
        self.kick_off == team && !self.dropped_ball
    }

    /// Whether a robot is off the field.
    pub fn is_removed(&self, robot: RobotId) -> bool {
        !self.removed.is_empty() && self.removed.binary_search_by_key(&robot, |removal| removal.robot).is_ok()
    }

    /// Takes a robot off the field for some seconds of playing time, forgets what it was about to be taken off for, and
    /// tells whether it was on the field: one that is off already stays as it is.
    pub(super) fn remove(&mut self, robot: RobotId, seconds_left: f64, reason: RemovalReason) -> bool {
        let Err(place) = self.removed.binary_search_by_key(&robot, |removal| removal.robot) else {
            return false;
        };
        self.removed.insert(place, Removal { robot, reason, seconds_left });
        self.defenders.retain(|defender| defender.robot != robot);
        for streaks in [&mut self.pushes, &mut self.on_keeper, &mut self.charges] {
            streaks.retain(|(other, _)| *other != robot);
        }
        self.pushed.retain(|(pushed, _)| *pushed != robot);
        self.hold = self.hold.filter(|hold| hold.robot != robot);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_ordered_as_a_match_passes_through_them() {
        let order = [Phase::Initial, Phase::Ready, Phase::Set, Phase::Playing, Phase::Finished];
        assert!(order.is_sorted());
    }

    #[test]
    fn playing_time_goes_on_through_the_second_half() {
        let book = RuleBook::default();
        let mut state = MatchState::new(Team::Home, &book);
        assert_eq!(state.time_played(&book), 0.0);
        (state.half, state.time_left) = (2, 100.0);
        assert_eq!(state.time_played(&book), 1100.0);
    }

    #[test]
    fn the_teams_attack_opposite_goals() {
        let mut state = MatchState::new(Team::Away, &RuleBook::default());
        assert_eq!(state.attacking(Team::Home), Attacking::East);
        assert_eq!(state.attacking(Team::Away), Attacking::West);
        state.home_attacks = Attacking::West;
        assert_eq!(state.attacking(Team::Away), Attacking::East);
    }

    #[test]
    fn a_removed_robot_is_found_and_removed_only_once() {
        let mut state = MatchState::new(Team::Home, &RuleBook::default());
        let (first, second) = (RobotId::new(Team::Home, 2), RobotId::new(Team::Away, 1));
        let reason = RemovalReason::Pushing;
        state.remove(second, 30.0, reason);
        state.remove(first, 20.0, reason);
        state.remove(first, 30.0, reason);
        assert_eq!(state.removed.iter().map(|r| r.robot).collect::<Vec<_>>(), [first, second]);
        assert!(state.is_removed(first) && !state.is_removed(RobotId::new(Team::Home, 1)));
        assert_eq!(state.removed[0].seconds_left, 20.0);
    }

    #[test]
    fn a_streak_outlasts_pauses_that_are_shorter_than_itself_and_counts_them() {
        let streak = Streak::default().after(1.0, true).and_then(|streak| streak.after(0.9, false)).unwrap();
        assert_eq!(streak, Streak { seconds: 1.0, paused: 0.9 });
        assert_eq!(streak.after(0.1, true), Some(Streak { seconds: 2.0, paused: 0.0 }));
        assert_eq!(streak.after(0.1, false), None);
    }

    #[test]
    fn a_streak_that_has_just_begun_survives_a_flicker() {
        let streak = Streak::default().after(0.1, false).unwrap();
        assert!(streak.after(0.05, true).is_some_and(|streak| (streak.seconds - 0.15).abs() < 1e-9));
        assert_eq!(streak.after(0.1, false), None);
    }
}
