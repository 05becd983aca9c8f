//! The `teamwork` section of a strategy: which mechanisms are on, who ranks above whom, how often a robot says what, and how
//! roles are swapped.

mod timing;

use serde::{Deserialize, Serialize};
use struct_patch::{Merge, Patch};

use crate::data::{Bound, Fault, Validate, check_all, ensure};
use crate::protocol::arbitration::ActionArbitration;
use crate::protocol::policy::{Policy, SwapRoles};
use crate::protocol::role_swap::{Ingredient, PaperRules, RoleIndex};
use crate::strategy::role::RoleRef;
pub use crate::strategy::team_ball::{BallBooking, BidBy, MapFusion};
use crate::strategy::team_ball::{BallBookingFile, MapFusionFile};
pub use timing::{MessageTiming, MessageTimingFile, TeamWatch, TeamWatchFile};

pub use super::mechanism::{Mechanism, Mechanisms};

/// Whom a robot takes for its team mates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TeammatesBy {
    /// Those whose markers it sees.
    #[default]
    Sight,
    /// Those whose position messages it hears (section V-A).
    Messages,
    /// Those whose position messages it hears, and others that it sees (section VIII).
    MessagesAndSight,
}

impl TeammatesBy {
    /// Whether messages count.
    pub fn hears(self) -> bool {
        self != TeammatesBy::Sight
    }

    /// Whether sight counts.
    pub fn sees(self) -> bool {
        self != TeammatesBy::Messages
    }
}

/// The section as it is written. What is left out is as in the strategy that a file is based on, or that a match or scenario
/// names; where there is none, robots neither talk nor arrange anything.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TeamworkFile {
    /// Those that are on; the [default](Mechanisms::default), if left out.
    pub mechanisms: Option<Vec<Mechanism>>,
    /// How a robot knows its team mates.
    pub teammates_by: Option<TeammatesBy>,
    /// How a robot knows which team mate has the ball and whether the goalie is out, and so when to support them; by messages,
    /// if left out (section VIII).
    pub supports_by: Option<TeammatesBy>,
    /// Roles by rank, the highest first; those that are missing rank lowest, all alike.
    pub hierarchy: Option<Vec<String>>,
    /// The role that sends goalie messages.
    pub goalie: Option<String>,
    /// When robots talk.
    pub talk: MessageTimingFile,
    /// What tells a robot that another one has the ball, or that the goalie is out.
    pub watch: TeamWatchFile,
    /// How roles are swapped.
    pub role_swap: Option<RoleSwapFile>,
    /// How the ball is booked.
    pub ball_booking: Option<BallBookingFile>,
    /// How ball reports become one place.
    pub global_map: MapFusionFile,
    /// How actions are given out.
    pub action_arbitration: Option<ActionArbitration>,
}

impl TeamworkFile {
    /// What it says and, where it says nothing, what `base` says.
    pub(crate) fn over(self, base: TeamworkFile) -> TeamworkFile {
        let swap = |base: RoleSwapFile| self.role_swap.clone().map_or(base.clone(), |own| own.over(base));
        let booking = |base: BallBookingFile| self.ball_booking.map_or(base, |own| base.merge(own));
        TeamworkFile {
            mechanisms: self.mechanisms.or(base.mechanisms),
            teammates_by: self.teammates_by.or(base.teammates_by),
            supports_by: self.supports_by.or(base.supports_by),
            hierarchy: self.hierarchy.or(base.hierarchy),
            goalie: self.goalie.or(base.goalie),
            talk: base.talk.merge(self.talk),
            watch: base.watch.merge(self.watch),
            role_swap: base.role_swap.map(swap).or(self.role_swap),
            ball_booking: base.ball_booking.map(booking).or(self.ball_booking),
            global_map: base.global_map.merge(self.global_map),
            action_arbitration: self.action_arbitration.or(base.action_arbitration),
        }
    }
}

/// How roles are swapped. A team that swaps needs protocol, policy and cast, here or in the strategy that this is based on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RoleSwapFile {
    /// By which protocol.
    pub protocol: Option<Protocol>,
    /// When.
    pub policy: Option<Policy>,
    /// Which roles.
    pub cast: Option<SwapRolesFile>,
    /// How long robots wait.
    pub timers: TimersFile,
}

impl RoleSwapFile {
    fn over(self, base: RoleSwapFile) -> RoleSwapFile {
        RoleSwapFile {
            protocol: self.protocol.or(base.protocol),
            policy: self.policy.or(base.policy),
            cast: self.cast.or(base.cast),
            timers: base.timers.merge(self.timers),
        }
    }
}

/// The version of the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Protocol {
    /// As in section VII of the paper.
    Paper(PaperRules),
    /// With ordered configurations that ride on position messages.
    Hardened,
    /// The hardened version with an ingredient left out, to see what it is for.
    HardenedWithout(Ingredient),
}

/// The roles that are swapped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SwapRolesFile {
    /// Plays in the middle.
    pub halfback: RoleRef,
    /// Stands in for others.
    pub floater: RoleRef,
    /// Attacks.
    pub forward: RoleRef,
}

/// How long a robot waits at each step of a swap, s.
#[derive(Clone, Copy, Debug, PartialEq, Patch)]
#[patch(
    name = "TimersFile",
    attribute(derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize))
)]
#[patch(attribute(serde(deny_unknown_fields, default)))]
#[patch(attribute(expect(missing_docs, reason = "the fields of what a file may leave out")))]
pub struct Timers {
    /// A locked robot for the next message of its initiator. Longer than the other two and two messages' delays.
    pub lock: f32,
    /// An initiator for the locks.
    pub locks: f32,
    /// An initiator for the acknowledgements of its reassignments.
    pub acks: f32,
    /// Least and greatest wait after an attempt that failed.
    pub back_off: (f32, f32),
}

impl Default for Timers {
    fn default() -> Timers {
        Timers { lock: 1.5, locks: 0.5, acks: 0.5, back_off: (0.5, 1.5) }
    }
}

impl Validate for Timers {
    fn validate(&self) -> Result<(), Fault> {
        let (least, most) = self.back_off;
        check_all([
            ("lock", self.lock, Bound::SECONDS.positive()),
            ("locks", self.locks, Bound::SECONDS.positive()),
            ("acks", self.acks, Bound::SECONDS.positive()),
            ("back_off.0", least, Bound::SECONDS),
            ("back_off.1", most, Bound::SECONDS),
        ])?;
        ensure(least <= most, "back_off", || "needs two times, the lesser one first".into())
    }
}

/// The section as it runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Teamwork {
    /// Those that are on.
    pub mechanisms: Mechanisms,
    /// How a robot knows its team mates.
    pub teammates_by: TeammatesBy,
    /// How a robot knows which team mate has the ball and whether the goalie is out.
    pub supports_by: TeammatesBy,
    /// The rank of each role, 0 highest.
    pub ranks: Vec<usize>,
    /// The role that sends goalie messages.
    pub goalie: Option<RoleIndex>,
    /// When robots talk.
    pub talk: MessageTiming,
    /// What tells a robot that another one has the ball, or that the goalie is out.
    pub watch: TeamWatch,
    /// How roles are swapped.
    pub role_swap: Option<RoleSwapSpec>,
    /// How the ball is booked.
    pub ball_booking: Option<BallBooking>,
    /// How ball reports become one place.
    pub global_map: MapFusion,
    /// How actions are given out.
    pub action_arbitration: Option<ActionArbitration>,
}

/// How roles are swapped, with every name looked up.
#[derive(Clone, Debug, PartialEq)]
pub struct RoleSwapSpec {
    /// By which protocol.
    pub protocol: Protocol,
    /// When.
    pub policy: Policy,
    /// Which roles.
    pub cast: SwapRoles,
    /// How long robots wait.
    pub timers: Timers,
}

impl Default for Teamwork {
    fn default() -> Teamwork {
        Teamwork {
            mechanisms: Mechanisms::default(),
            teammates_by: TeammatesBy::default(),
            supports_by: TeammatesBy::Messages,
            ranks: Vec::new(),
            goalie: None,
            talk: MessageTiming::default(),
            watch: TeamWatch::default(),
            role_swap: None,
            ball_booking: None,
            global_map: MapFusion::default(),
            action_arbitration: None,
        }
    }
}

impl Teamwork {
    /// Whether a role ranks above another. Where there is no hierarchy, none does.
    pub fn outranks(&self, role: usize, other: usize) -> bool {
        let rank = |role: usize| self.ranks.get(role).copied().unwrap_or(usize::MAX);
        rank(role) < rank(other)
    }

    /// Whether a mechanism is on.
    pub fn has(&self, mechanism: Mechanism) -> bool {
        self.mechanisms.has(mechanism)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_decide_who_outranks_whom() {
        let teamwork = Teamwork { ranks: vec![1, 0, 2, 2], ..Teamwork::default() };
        assert!(teamwork.outranks(1, 0) && teamwork.outranks(0, 2));
        assert!(!teamwork.outranks(2, 3) && !teamwork.outranks(3, 2) && !teamwork.outranks(0, 0));
    }
}
