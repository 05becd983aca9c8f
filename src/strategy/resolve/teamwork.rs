//! The `teamwork` section: roles looked up, numbers checked.

use struct_patch::Patch;

use super::Result;
use crate::data::{Bound, Field, Source, no_such};
use crate::protocol::policy::SwapRoles;
use crate::protocol::role_swap::RoleIndex;
use crate::strategy::teamwork::{
    BallBooking, Mechanism, Mechanisms, MessageTiming, RoleSwapFile, RoleSwapSpec, SwapRolesFile, Teamwork,
    TeamworkFile, Timers,
};

/// The names of a strategy's roles in their order, and the text in which they are looked up.
pub(in crate::strategy) struct Roles<'a> {
    pub names: Vec<&'a str>,
    pub source: &'a Source,
}

impl Roles<'_> {
    /// The section that the text has at `at`.
    pub(in crate::strategy) fn teamwork(&self, file: &TeamworkFile, at: &Field) -> Result<Teamwork> {
        let hierarchy = file.hierarchy.as_deref().unwrap_or_default();
        let at_hierarchy = at.key("hierarchy");
        self.source.distinct(&at_hierarchy, hierarchy)?;
        let names = file.mechanisms.iter().flatten().map(|mechanism| format!("{mechanism:?}"));
        self.source.distinct(&at.key("mechanisms"), &names.collect::<Vec<_>>())?;
        let mechanisms = file.mechanisms.as_ref();
        let mechanisms = mechanisms.map_or_else(Mechanisms::default, |on| on.iter().copied().collect());
        let mut ranks = vec![hierarchy.len(); self.names.len()];
        for (rank, name) in hierarchy.iter().enumerate() {
            ranks[usize::from(self.index(name, &at_hierarchy.index(rank))?)] = rank;
        }
        let goalie = file.goalie.as_ref().map(|name| self.index(name, &at.key("goalie"))).transpose()?;
        let mut talk = MessageTiming::default();
        talk.apply(file.talk);
        self.talk(&talk, &at.key("talk"))?;
        let role_swap = file.role_swap.as_ref().map(|swap| self.role_swap(swap, &at.key("role_swap")));
        let mut ball_booking = None;
        if let Some(file) = file.ball_booking {
            let booking = ball_booking.insert(BallBooking::default());
            booking.apply(file);
            self.ball_booking(booking, &at.key("ball_booking"))?;
        }
        Ok(Teamwork {
            mechanisms,
            teammates_by: file.teammates_by.unwrap_or_default(),
            ranks,
            goalie,
            talk,
            role_swap: role_swap.transpose()?.filter(|_| mechanisms.has(Mechanism::RoleSwap)),
            ball_booking: ball_booking.filter(|_| mechanisms.has(Mechanism::BallBooking)),
        })
    }

    /// The place of a role, by its name.
    pub(super) fn index(&self, name: &str, at: &Field) -> Result<RoleIndex> {
        let Some(index) = self.names.iter().position(|role| *role == name) else {
            return Err(self.source.error_at(at, no_such("role", name, &self.names)));
        };
        RoleIndex::try_from(index).map_err(|_| self.source.error_at(at, "a strategy has 256 roles at most"))
    }

    fn within(&self, value: f32, bound: Bound, at: &Field) -> Result<()> {
        self.source.within(at, value, bound)
    }

    fn talk(&self, talk: &MessageTiming, at: &Field) -> Result<()> {
        self.within(talk.position_every, Bound::SECONDS.positive(), &at.key("position_every"))?;
        self.within(talk.position_memory, Bound::SECONDS, &at.key("position_memory"))?;
        self.within(talk.claim_every, Bound::SECONDS.positive(), &at.key("claim_every"))?;
        self.within(talk.claim_memory, Bound::SECONDS, &at.key("claim_memory"))?;
        self.within(talk.claim_radius, Bound::LENGTH, &at.key("claim_radius"))?;
        self.within(talk.ball_every, Bound::SECONDS.positive(), &at.key("ball_every"))?;
        self.within(talk.ball_memory, Bound::SECONDS, &at.key("ball_memory"))
    }

    fn ball_booking(&self, booking: &BallBooking, at: &Field) -> Result<()> {
        self.within(booking.threshold, Bound::LENGTH, &at.key("threshold"))?;
        self.within(booking.renewal, Bound::SECONDS.positive(), &at.key("renewal"))?;
        self.within(booking.sight, Bound::SECONDS.positive(), &at.key("sight"))?;
        self.within(booking.timeout, Bound::SECONDS, &at.key("timeout"))?;
        if booking.timeout <= booking.renewal {
            let message =
                format!("must be longer than the renewal of {} s, or every booking lapses", booking.renewal);
            return Err(self.source.error_at(&at.key("timeout"), message));
        }
        Ok(())
    }

    fn role_swap(&self, file: &RoleSwapFile, at: &Field) -> Result<RoleSwapSpec> {
        let protocol = self.source.required(&file.protocol, at, "protocol")?;
        let policy = self.source.required(&file.policy, at, "policy")?;
        let cast = self.source.required(&file.cast, at, "cast")?;
        if let Some((field, message)) = policy.fault() {
            return Err(self.source.error_at(&at.key("policy").dotted(&field), message));
        }
        let mut timers = Timers::default();
        timers.apply(file.timers);
        self.timers(&timers, &at.key("timers"))?;
        Ok(RoleSwapSpec { protocol, policy, cast: self.cast(&cast, &at.key("cast"))?, timers })
    }

    fn cast(&self, cast: &SwapRolesFile, at: &Field) -> Result<SwapRoles> {
        let halfback = self.index(&cast.halfback.name, &at.key("halfback"))?;
        let floater = self.index(&cast.floater.name, &at.key("floater"))?;
        let forward = self.index(&cast.forward.name, &at.key("forward"))?;
        if halfback == floater || floater == forward || forward == halfback {
            return Err(self.source.error_at(at, "needs three different roles"));
        }
        Ok(SwapRoles { halfback, floater, forward })
    }

    fn timers(&self, timers: &Timers, at: &Field) -> Result<()> {
        self.within(timers.lock, Bound::SECONDS.positive(), &at.key("lock"))?;
        self.within(timers.locks, Bound::SECONDS.positive(), &at.key("locks"))?;
        self.within(timers.acks, Bound::SECONDS.positive(), &at.key("acks"))?;
        let (least, most) = timers.back_off;
        self.within(least, Bound::SECONDS, &at.key("back_off").index(0))?;
        self.within(most, Bound::SECONDS, &at.key("back_off").index(1))?;
        if least > most {
            let message = "needs two times, the lesser one first";
            return Err(self.source.error_at(&at.key("back_off"), message));
        }
        Ok(())
    }
}
