//! The record of a match: all figures together.

use bevy::prelude::*;

use super::bookings::BookingFigures;
use super::contacts::RobotContacts;
use super::crowding::Crowding;
use super::holds::HoldFigures;
use super::kicks::{GripFigures, KickFigures, count_falls};
use super::localisation::LocalisationFigures;
use super::loose_balls::LooseBalls;
use super::overlap::BallOverlap;
use super::places::PlaceFigures;
use super::play_tick::PlayTick;
use super::pursuit::Pursuit;
use super::removals::Removals;
use super::role_cover::RoleCover;
use crate::ids::{RobotId, Team};
use crate::rng::Seed;

/// Figures about the match so far. Where there are two, home is first. Only time of play counts.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct Record {
    /// Equal digests mean equal matches: all poses, roles, activities, role swaps and the score at all ticks, and how much was
    /// said.
    pub digest: u64,
    /// Seconds of play in which each team was the last one near the ball.
    pub possession: [f64; 2],
    /// How much the teams crowded the ball.
    pub crowding: Crowding,
    /// Where the ball and the robots were.
    pub places: PlaceFigures,
    /// Who drove at the ball, told from what robots do.
    pub pursuit: [Pursuit; 2],
    /// How well each team's ball booking has worked, told from what its robots believe.
    pub bookings: [BookingFigures; 2],
    /// How well each team's robots knew their places.
    pub localisation: [LocalisationFigures; 2],
    /// Who touched whom.
    pub contacts: RobotContacts,
    /// Balls that nobody touched, and who won them.
    pub loose_balls: LooseBalls,
    /// The kicks of each team.
    pub kicks: [KickFigures; 2],
    /// What each team's chins did.
    pub grips: [GripFigures; 2],
    /// How often robots of each team fell.
    pub falls: [u32; 2],
    /// Whom the referee took off, and why.
    pub removals: Removals,
    /// How often the referee put the ball elsewhere, or gave a kick-off, since nothing came of play.
    pub no_progress: u32,
    /// How long robots kept their roles, by index.
    pub roles: [HoldFigures<usize>; 2],
    /// For how long roles had nobody, or more robots than they should.
    pub role_cover: [RoleCover; 2],
    /// How long robots kept the states of their machines, by indices of role and state.
    pub states: [HoldFigures<(usize, usize)>; 2],
    /// How deep the ball has sunk into robots and walls.
    pub overlap: BallOverlap,
    /// Seconds of play.
    pub played: f64,
    /// Metres driven by each robot, by robot in order.
    pub driven: Vec<(RobotId, f64)>,
    pub(super) last_near: Option<Team>,
}

/// A robot nearer to the ball than this has it, m.
const POSSESSION: f32 = 0.5;

impl Record {
    /// An empty record of a match between these robots, in order.
    pub fn new(seed: Seed, robots: impl IntoIterator<Item = RobotId>) -> Record {
        Record {
            digest: seed.0,
            possession: [0.0; 2],
            crowding: Crowding::default(),
            places: PlaceFigures::default(),
            pursuit: Default::default(),
            bookings: Default::default(),
            localisation: Default::default(),
            contacts: RobotContacts::default(),
            loose_balls: LooseBalls::default(),
            kicks: Default::default(),
            grips: Default::default(),
            falls: [0; 2],
            removals: Removals::default(),
            no_progress: 0,
            roles: Default::default(),
            role_cover: Default::default(),
            states: Default::default(),
            overlap: BallOverlap::default(),
            played: 0.0,
            driven: robots.into_iter().map(|robot| (robot, 0.0)).collect(),
            last_near: None,
        }
    }

    /// `at_kick_off` has the indices of the roles of all players of each team.
    pub(super) fn update(&mut self, tick: &PlayTick, at_kick_off: [&[usize]; 2]) {
        self.played += tick.dt;
        self.note_possession(tick);
        self.note_ways(tick);
        self.crowding.update(tick);
        self.places.update(tick);
        self.contacts.update(&tick.touching, tick.now, tick.dt);
        self.loose_balls.update(tick);
        for team in Team::BOTH {
            let i = team.index();
            self.pursuit[i].update(team, tick);
            self.role_cover[i].update(team, at_kick_off[i], tick);
            if !tick.events.is_empty() {
                self.kicks[i].update(team, &tick.events);
                self.grips[i].update(team, &tick.events);
                self.falls[i] += count_falls(team, &tick.events);
            }
            let playing = || tick.of(team).filter(|player| player.plays);
            self.roles[i].update(playing().map(|it| (it.id.number, it.role)), tick.now, tick.dt);
            self.states[i].update(playing().map(|it| (it.id.number, it.state)), tick.now, tick.dt);
        }
    }

    /// Play is interrupted.
    pub(super) fn interrupt(&mut self) {
        self.contacts.interrupt();
        self.loose_balls.interrupt();
        self.pursuit.iter_mut().for_each(Pursuit::interrupt);
        self.roles.iter_mut().for_each(HoldFigures::interrupt);
        self.states.iter_mut().for_each(HoldFigures::interrupt);
        self.role_cover.iter_mut().for_each(RoleCover::interrupt);
        self.localisation.iter_mut().for_each(LocalisationFigures::interrupt);
    }

    fn note_possession(&mut self, tick: &PlayTick) {
        let mut nearest: Option<(f32, RobotId)> = None;
        for player in &tick.players {
            let known = (player.distance, player.id);
            if player.distance < POSSESSION && nearest.is_none_or(|best| known < best) {
                nearest = Some(known);
            }
        }
        self.last_near = nearest.map(|(_, id)| id.team).or(self.last_near);
        if let Some(team) = self.last_near {
            self.possession[team.index()] += tick.dt;
        }
    }

    fn note_ways(&mut self, tick: &PlayTick) {
        for player in &tick.players {
            if let Ok(index) = self.driven.binary_search_by_key(&player.id, |(robot, _)| *robot) {
                self.driven[index].1 += f64::from(player.velocity.length()) * tick.dt;
            }
        }
    }

    /// Each team's share of the time in which either had the ball, home first; a half each if nobody ever had it.
    pub fn possession_shares(&self) -> [f64; 2] {
        shares(self.possession)
    }

    /// Metres that a team's robots have driven together.
    pub fn driven_by(&self, team: Team) -> f64 {
        self.driven.iter().filter(|(robot, _)| robot.team == team).map(|(_, way)| way).sum()
    }
}

fn shares([home, away]: [f64; 2]) -> [f64; 2] {
    let total = home + away;
    if total > 0.0 { [home / total, away / total] } else { [0.5, 0.5] }
}
