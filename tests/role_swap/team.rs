//! What a run of the checker is about: the team, its version of the protocol, its radio, its timers and its misfortunes.

use touchline::ids::PlayerNumber;
use touchline::protocol::role_swap::{
    Assignment, Hardened, Ingredient, OnMissingAck, Paper, PaperRules, Reassignment, RoleIndex, RoleSwap,
    Unlock,
};

use super::checks::Check;
use super::network::Radio;

pub const HALFBACK: RoleIndex = 0;
pub const FLOATER: RoleIndex = 1;
pub const FORWARD: RoleIndex = 2;

/// A model: robot 0 starts as the halfback, 1 as the floater, 2 as the forward and 3, if there is one, as the goalie.
#[derive(Clone, Debug)]
pub struct Team {
    pub version: Version,
    pub robots: u8,
    pub radio: Radio,
    pub initiators_timers: Timing,
    pub lock_timers: Timing,
    /// For each attempt in turn the robots of which one may begin it.
    pub attempts: Vec<Vec<PlayerNumber>>,
    pub asked: Asked,
    pub wanted: Wanted,
    pub crashes: Crashes,
    /// Whether position messages carry configurations.
    pub news: bool,
    pub checks: Vec<Check>,
}

#[derive(Clone, Copy, Debug)]
pub enum Version {
    Paper(PaperRules),
    Hardened(Option<Ingredient>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// A timer runs out only when nothing of what it guards can come any more.
    Ideal,
    /// A timer that runs may run out at any moment.
    Any,
}

/// Whom an initiator asks for locks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    Everybody,
    /// Any of the others, or none: it may be wrong about who is alive.
    Anybody,
}

/// What an initiator wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Robot 0 the paper's rotation, robot 1 its inverse, robot 2 that halfback and forward change places.
    Own,
    /// Any assignment of the first three roles to the first three robots.
    Any,
}

#[derive(Clone, Debug)]
pub struct Crashes {
    pub at_most: u8,
    pub of: Vec<PlayerNumber>,
    pub afterwards: Afterwards,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Afterwards {
    StaysDown,
    Restarts { memory_kept: bool },
}

impl Crashes {
    pub fn any(at_most: u8, afterwards: Afterwards) -> Crashes {
        Crashes { at_most, of: vec![0, 1, 2], afterwards }
    }
}

impl Team {
    /// Three robots, a reliable radio, ideal timers, no crash and one attempt, of robot 0.
    pub fn new(version: Version) -> Team {
        Team {
            version,
            robots: 3,
            radio: Radio::RELIABLE,
            initiators_timers: Timing::Ideal,
            lock_timers: Timing::Ideal,
            attempts: vec![vec![0]],
            asked: Asked::Everybody,
            wanted: Wanted::Own,
            crashes: Crashes::any(0, Afterwards::StaysDown),
            news: true,
            checks: Vec::new(),
        }
    }

    pub fn paper(on_missing_ack: OnMissingAck, unlock: Unlock) -> Team {
        Team::new(Version::Paper(PaperRules { on_missing_ack, unlock, ..PaperRules::default() }))
    }

    /// The hardened version, over a radio that loses anything, with this many attempts of anybody.
    pub fn hardened(attempts: usize) -> Team {
        let attempts = vec![vec![0, 1, 2]; attempts];
        Team { radio: Radio::LOSSY, attempts, ..Team::new(Version::Hardened(None)) }
    }

    pub fn any_timers(self) -> Team {
        Team { initiators_timers: Timing::Any, lock_timers: Timing::Any, ..self }
    }

    pub fn roles_at_start(&self) -> Assignment {
        Assignment::new(0..self.robots)
    }

    pub fn machine(&self, robot: PlayerNumber) -> RoleSwap {
        let all = self.roles_at_start();
        match self.version {
            Version::Paper(rules) => RoleSwap::Paper(Paper::new(robot, all, rules)),
            Version::Hardened(None) => RoleSwap::Hardened(Hardened::new(robot, all)),
            Version::Hardened(Some(left_out)) => RoleSwap::Hardened(Hardened::without(robot, all, left_out)),
        }
    }

    pub fn reassignments(&self, initiator: PlayerNumber) -> Vec<Reassignment> {
        let roles: &[(RoleIndex, RoleIndex)] = match initiator {
            0 => &[(HALFBACK, FORWARD), (FORWARD, FLOATER), (FLOATER, HALFBACK)],
            1 => &[(FORWARD, HALFBACK), (FLOATER, FORWARD), (HALFBACK, FLOATER)],
            _ => &[(HALFBACK, FORWARD), (FORWARD, HALFBACK)],
        };
        match self.wanted {
            Wanted::Own => vec![Reassignment::Roles(roles.into())],
            Wanted::Any => {
                let all = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
                let named = |roles: [RoleIndex; 3]| (0..).zip(roles).collect();
                all.into_iter().map(|roles| Reassignment::Robots(named(roles))).collect()
            }
        }
    }

    /// The groups of robots that an initiator may ask.
    pub fn groups(&self, initiator: PlayerNumber) -> Vec<Vec<PlayerNumber>> {
        let others: Vec<PlayerNumber> = (0..self.robots).filter(|robot| *robot != initiator).collect();
        match self.asked {
            Asked::Everybody => vec![others],
            Asked::Anybody => (0_u32..1 << others.len()).map(|chosen| subset(&others, chosen)).collect(),
        }
    }
}

/// The members that the bits choose.
pub fn subset<T: Copy>(all: &[T], chosen: u32) -> Vec<T> {
    all.iter().enumerate().filter(|(place, _)| chosen >> place & 1 == 1).map(|(_, member)| *member).collect()
}
