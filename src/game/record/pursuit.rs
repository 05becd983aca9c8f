//! Who drives at the ball, told from what robots do: where their motors are told to take them, and whether they handle the ball.
//! What a robot believes, has claimed or has booked plays no part.

use bevy::prelude::*;
use serde::Serialize;
use smallvec::SmallVec;

use super::play_tick::{PlayTick, PlayerTick};
use super::replacement::Replacement;
use super::span::Span;
use crate::ids::{PlayerNumber, Team};

/// For how long nobody, one or several robots of a team drove at the ball. The three times add up to the time of play.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Pursuit {
    /// Nobody did.
    pub nobody: Span,
    /// One robot did.
    pub one: Span,
    /// Two or more did.
    pub several: Span,
    /// One did while a team mate that played was nearer to the ball by more than [`FARTHER`].
    pub farther: Span,
    /// How often another robot was the one that did.
    pub takeovers: u64,
    /// Takeovers back to the robot before within [`PING_PONG`].
    pub alternations: u64,
    /// How soon one that went out of play was replaced.
    pub replacement: Replacement,
    /// Until when each robot counts as driving at the ball, by its number, s of play.
    #[serde(skip)]
    until: SmallVec<[f64; 8]>,
    /// Those that drive at the ball now.
    #[serde(skip)]
    driving: SmallVec<[PlayerNumber; 8]>,
    /// The last two that were the only one, the last one last, each with the time at which it became that.
    #[serde(skip)]
    last: [Option<(PlayerNumber, f64)>; 2],
}

/// Two takeovers within this time, back to where the ball was, are an alternation, s.
pub const PING_PONG: f64 = 3.0;
/// A team mate that is nearer by more than this might rather go, m.
pub const FARTHER: f32 = 0.3;

/// Slower motion goes nowhere, m/s.
const MOVES: f32 = 0.05;
/// Motion that takes longer to the ball is about something else, s.
const SOON: f32 = 5.0;
/// The cosine of the angle up to which motion goes to the ball: 20°.
const AHEAD: f32 = 0.94;
/// A moving ball may be met where it will be after this time, s.
const LEAD: f32 = 0.5;
/// This near a robot is at the ball, m: it may go round it, but not away from it.
const AT_BALL: f32 = 0.4;
/// The cosine of the angle from which on motion leads away: 120°.
const AWAY: f32 = -0.5;
/// A robot that brakes or turns for less than this still drives at the ball, s.
const HOLD: f64 = 0.5;

impl Pursuit {
    pub(super) fn update(&mut self, team: Team, tick: &PlayTick) {
        let before = self.only();
        self.driving.clear();
        let (mut goer, mut nearest_other) = (None, f32::INFINITY);
        for player in tick.players.iter().filter(|player| player.id.team == team && player.plays) {
            if self.goes(player, tick) {
                self.driving.push(player.id.number);
                goer = Some(player);
            } else {
                nearest_other = nearest_other.min(player.distance);
            }
        }
        let going = self.driving.len();
        let is_gone = |number| !tick.of(team).any(|it| it.plays && it.id.number == number);
        if before.is_some_and(is_gone) {
            self.replacement.miss(tick.now);
        }
        if going > 0 {
            self.replacement.go(tick.now);
        }
        let only = goer.filter(|_| going == 1);
        self.nobody.update(going == 0, tick.dt);
        self.one.update(going == 1, tick.dt);
        self.several.update(going > 1, tick.dt);
        self.farther.update(only.is_some_and(|only| nearest_other + FARTHER < only.distance), tick.dt);
        if let Some(only) = only {
            self.note_only(only.id.number, tick.now);
        }
    }

    /// Play is interrupted: nobody drives at the ball any more, and stretches of time end.
    pub(super) fn interrupt(&mut self) {
        self.until.clear();
        self.driving.clear();
        self.last = [None; 2];
        self.replacement.interrupt();
        for span in [&mut self.nobody, &mut self.one, &mut self.several, &mut self.farther] {
            span.update(false, 0.0);
        }
    }

    /// Whether a robot drives at the ball, as of the last tick.
    pub fn drives(&self, number: PlayerNumber) -> bool {
        self.driving.contains(&number)
    }

    /// The robot that alone drove at the ball, as of the last tick.
    fn only(&self) -> Option<PlayerNumber> {
        match self.driving.as_slice() {
            [number] => Some(*number),
            _ => None,
        }
    }

    /// Whether a robot drives at the ball, or did a moment ago.
    fn goes(&mut self, player: &PlayerTick, tick: &PlayTick) -> bool {
        let place = usize::from(player.id.number);
        if drives_at_ball(player, tick) {
            if self.until.len() <= place {
                self.until.resize(place + 1, f64::NEG_INFINITY);
            }
            self.until[place] = tick.now + HOLD;
        }
        self.until.get(place).is_some_and(|until| tick.now < *until)
    }

    fn note_only(&mut self, number: PlayerNumber, now: f64) {
        let [before, last] = self.last;
        if last.is_some_and(|(last, _)| last == number) {
            return;
        }
        self.takeovers += u64::from(last.is_some());
        // The one before the last went until the last one began.
        let is_back = before
            .zip(last)
            .is_some_and(|((before, _), (_, until))| before == number && now - until < PING_PONG);
        self.alternations += u64::from(is_back);
        self.last = [last, Some((number, now))];
    }
}

/// Whether a robot drives at the ball in this tick: it plays, and holds the ball, kicks it, is told to move so that it is soon there or
/// where it will be, or is at it and is not told to move away.
fn drives_at_ball(player: &PlayerTick, tick: &PlayTick) -> bool {
    if !player.plays {
        return false;
    }
    if player.holds || player.kicks && player.distance < AT_BALL {
        return true;
    }
    let speed = player.told.length();
    if speed < MOVES {
        return false;
    }
    let to_ball = tick.ball - player.position;
    let direction = |target: Vec2| player.told.dot(target) / (speed * target.length()).max(f32::MIN_POSITIVE);
    if player.distance < AT_BALL {
        return direction(to_ball) > AWAY;
    }
    let leads_to = |target: Vec2| direction(target) > AHEAD && target.length() < speed * SOON;
    leads_to(to_ball) || leads_to(to_ball + tick.ball_velocity * LEAD)
}

#[cfg(test)]
mod tests {
    use super::super::play_tick::stage::*;
    use super::*;

    /// A robot of home that is told to move.
    fn told(id: crate::ids::RobotId, at: (f32, f32), told: (f32, f32)) -> PlayerTick {
        PlayerTick { told: told.into(), ..player(id, at.0, at.1) }
    }

    fn drives(player: PlayerTick) -> bool {
        drives_at_ball(&player, &tick(&[player]))
    }

    #[test]
    fn motion_towards_the_ball_counts_and_motion_past_it_or_from_afar_does_not() {
        assert!(drives(told(HOME_1, (-1.0, 0.0), (0.3, 0.1))));
        assert!(!drives(told(HOME_1, (-1.0, 0.0), (0.3, 0.3))), "past it");
        assert!(!drives(told(HOME_1, (-1.0, 0.0), (0.04, 0.0))), "it stands");
        assert!(!drives(told(HOME_1, (-1.6, 0.0), (0.3, 0.0))), "it is there too late");
        assert!(drives(told(HOME_1, (-1.6, 0.0), (0.4, 0.0))));
        assert!(!drives(PlayerTick { plays: false, ..told(HOME_1, (-1.0, 0.0), (0.3, 0.0)) }));
    }

    #[test]
    fn a_blocked_robot_drives_at_the_ball_though_it_does_not_move_and_a_pushed_one_does_not() {
        assert!(drives(PlayerTick { velocity: Vec2::ZERO, ..told(HOME_1, (-0.5, 0.0), (0.3, 0.0)) }));
        assert!(!drives(PlayerTick { velocity: Vec2::X, ..told(HOME_1, (-0.5, 0.0), (0.0, 0.0)) }));
    }

    #[test]
    fn a_robot_at_the_ball_may_go_round_it_but_not_away() {
        assert!(drives(told(HOME_1, (-0.3, 0.0), (0.0, 0.3))));
        assert!(!drives(told(HOME_1, (-0.3, 0.0), (-0.3, 0.1))));
        assert!(!drives(told(HOME_1, (-0.5, 0.0), (0.0, 0.3))));
        assert!(drives(PlayerTick { holds: true, ..player(HOME_1, -0.2, 0.0) }), "it holds the ball");
    }

    #[test]
    fn a_moving_ball_may_be_met_where_it_will_be() {
        let robot = told(HOME_1, (-1.0, 0.0), (0.3, 0.3));
        let tick = PlayTick { ball_velocity: Vec2::new(0.0, 1.6), ..tick(&[robot]) };
        assert!(drives_at_ball(&robot, &tick));
    }

    #[test]
    fn nobody_one_and_several_share_the_time_of_play() {
        let (at, away) = (told(HOME_1, (-1.0, 0.0), (0.3, 0.0)), player(HOME_2, 1.0, 0.0));
        let other = told(HOME_2, (1.0, 0.0), (-0.3, 0.0));
        let (mut pursuit, mut now) = (Pursuit::default(), 0.0);
        run(&mut now, 10, &tick(&[player(HOME_1, -1.0, 0.0), away]), |tick| pursuit.update(Team::Home, tick));
        run(&mut now, 10, &tick(&[at, away]), |tick| pursuit.update(Team::Home, tick));
        run(&mut now, 20, &tick(&[at, other]), |tick| pursuit.update(Team::Home, tick));
        let totals = [pursuit.nobody, pursuit.one, pursuit.several].map(|span| (span.total * 10.0).round());
        assert_eq!(totals, [10.0, 10.0, 20.0]);
    }

    #[test]
    fn a_robot_that_stops_for_a_moment_still_goes() {
        let (mut pursuit, mut now) = (Pursuit::default(), 0.0);
        let (drives, stands) = (told(HOME_1, (-1.0, 0.0), (0.3, 0.0)), player(HOME_1, -1.0, 0.0));
        run(&mut now, 1, &tick(&[drives]), |tick| pursuit.update(Team::Home, tick));
        run(&mut now, 9, &tick(&[stands]), |tick| pursuit.update(Team::Home, tick));
        assert_eq!((pursuit.one.total * 10.0).round(), 5.0);
        assert_eq!((pursuit.nobody.total * 10.0).round(), 5.0);
    }

    #[test]
    fn a_farther_robot_that_goes_alone_is_noticed() {
        let (mut pursuit, mut now) = (Pursuit::default(), 0.0);
        let goes = told(HOME_1, (-1.0, 0.0), (0.3, 0.0));
        run(&mut now, 5, &tick(&[goes, player(HOME_2, 0.0, 0.6)]), |tick| pursuit.update(Team::Home, tick));
        run(&mut now, 5, &tick(&[goes, player(HOME_2, 0.0, 0.8)]), |tick| pursuit.update(Team::Home, tick));
        let off = PlayerTick { plays: false, ..player(HOME_2, 0.0, 0.6) };
        run(&mut now, 5, &tick(&[goes, off]), |tick| pursuit.update(Team::Home, tick));
        assert_eq!((pursuit.farther.total * 10.0).round(), 5.0);
    }

    #[test]
    fn a_ball_that_comes_back_soon_has_alternated() {
        let (mut pursuit, mut now) = (Pursuit::default(), 0.0);
        let (one, other) = (told(HOME_1, (-1.0, 0.0), (0.3, 0.0)), told(HOME_2, (1.0, 0.0), (-0.3, 0.0)));
        for (robot, tenths) in [(one, 50), (other, 20), (one, 50), (other, 40), (one, 10)] {
            run(&mut now, tenths, &tick(&[robot]), |tick| pursuit.update(Team::Home, tick));
        }
        assert_eq!((pursuit.takeovers, pursuit.alternations), (4, 1));
    }

    #[test]
    fn who_drove_alone_and_went_out_of_play_is_replaced_sooner_or_later() {
        let (mut pursuit, mut now) = (Pursuit::default(), 0.0);
        let (one, other) = (told(HOME_1, (-1.0, 0.0), (0.3, 0.0)), told(HOME_2, (1.0, 0.0), (-0.3, 0.0)));
        let stands = player(HOME_2, 1.0, 0.0);
        let off = PlayerTick { plays: false, ..one };
        for (tenths, robots) in
            [(10, [one, stands]), (12, [off, stands]), (10, [off, other]), (9, [one, stands])]
        {
            run(&mut now, tenths, &tick(&robots), |tick| pursuit.update(Team::Home, tick));
        }
        run(&mut now, 5, &tick(&[off, other]), |tick| pursuit.update(Team::Home, tick));
        let tenths: Vec<f64> =
            pursuit.replacement.seconds.iter().map(|seconds| (seconds * 10.0).round()).collect();
        assert_eq!(tenths, [12.0, 0.0], "the other one at once");
    }

    #[test]
    fn an_interruption_ends_stretches_and_forgets_who_went() {
        let (mut pursuit, mut now) = (Pursuit::default(), 0.0);
        let goes = told(HOME_1, (-1.0, 0.0), (0.3, 0.0));
        for _ in 0..2 {
            run(&mut now, 10, &tick(&[goes]), |tick| pursuit.update(Team::Home, tick));
            pursuit.interrupt();
        }
        assert_eq!((pursuit.one.longest * 10.0).round(), 10.0);
        run(&mut now, 1, &tick(&[told(HOME_2, (1.0, 0.0), (-0.3, 0.0))]), |tick| {
            pursuit.update(Team::Home, tick)
        });
        assert_eq!(pursuit.takeovers, 0);
    }
}
