//! Where play takes place: on whose side the ball is, and how far team mates are from each other.

use super::crowding::{CROWD, RADII};
use super::play_tick::{PlayTick, PlayerTick};
use crate::ids::Team;

/// Where the ball and the robots were.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlaceFigures {
    /// How far the ball was from the centre towards the goal that home attacks, summed over time, m s.
    ball_ahead: f64,
    /// For how long fewer than two robots were on their own goal's side of the ball, s; home first.
    undefended: [f64; 2],
    /// The same with none.
    unguarded: [f64; 2],
    /// For how long two or more robots were in their own penalty area, s; home first.
    two_in_area: [f64; 2],
    /// Robots within [`RADII`] of a crowd round the ball, summed over time, s; home first.
    near_ball: [f64; 2],
    /// From each robot to its nearest team mate summed over time, m s; home first.
    to_mates: [f64; 2],
    /// The time of all robots that had a team mate, s.
    with_mates: [f64; 2],
}

impl PlaceFigures {
    pub(super) fn update(&mut self, tick: &PlayTick) {
        self.ball_ahead += f64::from(tick.ahead(Team::Home, tick.ball)) * tick.dt;
        for team in Team::BOTH {
            let ball = tick.ahead(team, tick.ball);
            let is_behind = |player: &&PlayerTick| player.plays && tick.ahead(team, player.position) < ball;
            let defenders = tick.of(team).filter(is_behind).count();
            add_if(&mut self.undefended[team.index()], defenders < 2, tick.dt);
            add_if(&mut self.unguarded[team.index()], defenders == 0, tick.dt);
            let is_in_area = |it: &&PlayerTick| tick.own_area.contains(tick.seen_by(team, it.position));
            add_if(
                &mut self.two_in_area[team.index()],
                tick.of(team).filter(is_in_area).count() > 1,
                tick.dt,
            );
            let near_ball = tick.of(team).filter(|player| player.distance < RADII[CROWD]).count();
            self.near_ball[team.index()] += near_ball as f64 * tick.dt;
            for player in tick.of(team) {
                let mates = tick.of(team).filter(|mate| mate.id != player.id);
                let nearest =
                    mates.map(|mate| mate.position.distance_squared(player.position)).reduce(f32::min);
                if let Some(squared) = nearest {
                    self.to_mates[team.index()] += f64::from(squared.sqrt()) * tick.dt;
                    self.with_mates[team.index()] += tick.dt;
                }
            }
        }
    }

    /// How far the ball was from the centre towards the goal that a team attacks, summed over the time of play, m s.
    pub fn territory(&self, team: Team) -> f64 {
        match team {
            Team::Home => self.ball_ahead,
            Team::Away => -self.ball_ahead,
        }
    }

    /// For how long fewer than two robots of a team that played, such as a goalie and a defender, were nearer to their own goal line
    /// than the ball was, s.
    pub fn undefended(&self, team: Team) -> f64 {
        self.undefended[team.index()]
    }

    /// For how long no robot of the team that played was nearer to its goal line than the ball, s.
    pub fn unguarded(&self, team: Team) -> f64 {
        self.unguarded[team.index()]
    }

    /// For how long two or more robots of the team were in their own penalty area, s.
    pub fn two_in_area(&self, team: Team) -> f64 {
        self.two_in_area[team.index()]
    }

    /// The time of each robot of the team within a metre of the ball, added up, s.
    pub fn near_ball(&self, team: Team) -> f64 {
        self.near_ball[team.index()]
    }

    /// The mean distance from a robot of the team to its nearest team mate, m; 0 if it never had one.
    pub fn mate_distance(&self, team: Team) -> f64 {
        let (sum, time) = (self.to_mates[team.index()], self.with_mates[team.index()]);
        if time > 0.0 { sum / time } else { 0.0 }
    }
}

fn add_if(sum: &mut f64, condition: bool, dt: f64) {
    if condition {
        *sum += dt;
    }
}

#[cfg(test)]
mod tests {
    use bevy::prelude::Vec2;

    use super::super::play_tick::stage::*;
    use super::*;
    use crate::geometry::{Attacking, Zone};

    #[test]
    fn the_nearest_mate_counts_and_a_robot_alone_has_none() {
        let mut places = PlaceFigures::default();
        places.update(&tick(&[player(HOME_1, 0.0, 0.0), player(HOME_2, 3.0, 4.0), player(AWAY_1, 0.0, 0.1)]));
        assert!((places.mate_distance(Team::Home) - 5.0).abs() < 1e-6);
        assert_eq!(places.mate_distance(Team::Away), 0.0);
    }

    #[test]
    fn two_robots_behind_the_ball_defend_and_one_that_is_off_does_not() {
        let undefended = |second: PlayerTick| {
            let mut places = PlaceFigures::default();
            places.update(&tick(&[player(HOME_1, -1.0, 0.0), second, player(AWAY_1, 1.0, 0.0)]));
            Team::BOTH.map(|team| places.undefended(team) > 0.0)
        };
        assert_eq!(undefended(player(HOME_2, -2.0, 2.0)), [false, true]);
        assert_eq!(undefended(player(HOME_2, 0.1, 0.0)), [true, true]);
        assert_eq!(undefended(PlayerTick { plays: false, ..player(HOME_2, -2.0, 2.0) }), [true, true]);
    }

    #[test]
    fn a_goal_is_unguarded_with_nobody_between_and_robots_in_their_area_are_counted_at_either_end() {
        let area = Zone { min: Vec2::new(-3.0, -1.0), max: Vec2::new(-2.0, 1.0) };
        let mut places = PlaceFigures::default();
        let players = [player(HOME_1, -2.5, 0.5), player(HOME_2, -2.5, -0.5), player(AWAY_1, -2.5, 0.0)];
        places.update(&PlayTick { own_area: area, ..tick(&players) });
        assert_eq!(Team::BOTH.map(|team| places.unguarded(team) > 0.0), [false, true]);
        assert_eq!(Team::BOTH.map(|team| places.two_in_area(team) > 0.0), [true, false]);
        let players = [players.as_slice(), &[player(AWAY_2, -2.2, 0.9)]].concat();
        let turned = PlayTick { own_area: area, home_attacks: Attacking::West, ..tick(&players) };
        let mut places = PlaceFigures::default();
        places.update(&turned);
        assert_eq!(Team::BOTH.map(|team| places.unguarded(team) > 0.0), [true, false]);
        assert_eq!(Team::BOTH.map(|team| places.two_in_area(team) > 0.0), [false, true]);
    }

    #[test]
    fn each_robot_within_a_metre_of_the_ball_counts() {
        let mut places = PlaceFigures::default();
        places.update(&tick(&[player(HOME_1, 0.9, 0.0), player(HOME_2, 0.0, 0.2), player(AWAY_1, 1.1, 0.0)]));
        assert!((places.near_ball(Team::Home) - 0.2).abs() < 1e-9);
        assert_eq!(places.near_ball(Team::Away), 0.0);
    }

    #[test]
    fn the_ball_is_in_the_territory_of_the_team_that_it_is_near_the_goal_of() {
        let mut places = PlaceFigures::default();
        let mut tick = tick(&[]);
        tick.ball.x = -2.0;
        places.update(&tick);
        assert!((places.territory(Team::Home) + 0.2).abs() < 1e-6);
        assert_eq!(places.territory(Team::Away), -places.territory(Team::Home));
    }
}
