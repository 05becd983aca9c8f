//! The `teamwork` section: roles looked up, numbers checked.

use super::{Resolver, Result};
use crate::data::{Bound, Field};
use crate::protocol::policy::SwapRoles;
use crate::protocol::role_swap::RoleIndex;
use crate::strategy::teamwork::{
    BallBooking, Mechanisms, MessageTiming, RoleSwapFile, RoleSwapSpec, SwapRolesFile, Teamwork,
    TeamworkFile, Timers,
};

impl Resolver<'_> {
    pub(super) fn teamwork(&self, at: &Field) -> Result<Teamwork> {
        let left_out = TeamworkFile::default();
        let file = self.file.teamwork.as_ref().unwrap_or(&left_out);
        let at_hierarchy = at.key("hierarchy");
        self.source.distinct(&at_hierarchy, &file.hierarchy)?;
        let mechanisms = file.mechanisms.iter().flatten().map(|mechanism| format!("{mechanism:?}"));
        self.source.distinct(&at.key("mechanisms"), &mechanisms.collect::<Vec<_>>())?;
        let mut ranks = vec![file.hierarchy.len(); self.file.roles.len()];
        for (rank, name) in file.hierarchy.iter().enumerate() {
            ranks[usize::from(self.role_index(name, &at_hierarchy.index(rank))?)] = rank;
        }
        let goalie =
            (file.goalie.as_ref()).map(|name| self.role_index(name, &at.key("goalie"))).transpose()?;
        self.talk(&file.talk, &at.key("talk"))?;
        if let Some(booking) = &file.ball_booking {
            self.ball_booking(booking, &at.key("ball_booking"))?;
        }
        let role_swap = match &file.role_swap {
            Some(swap) => Some(self.role_swap(swap, &at.key("role_swap"))?),
            None => None,
        };
        Ok(Teamwork {
            mechanisms: (file.mechanisms.as_ref())
                .map_or_else(Mechanisms::default, |on| on.iter().copied().collect()),
            teammates_by: file.teammates_by,
            ranks,
            goalie,
            talk: file.talk,
            role_swap,
            ball_booking: file.ball_booking,
        })
    }

    /// The place of a role, by its name.
    pub(super) fn role_index(&self, name: &str, at: &Field) -> Result<RoleIndex> {
        let index = self.index(&self.file.roles, "role", name, at)?;
        RoleIndex::try_from(index).or_else(|_| self.fault(at, "a strategy has 256 roles at most"))
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
            return self.fault(&at.key("timeout"), message);
        }
        Ok(())
    }

    fn role_swap(&self, file: &RoleSwapFile, at: &Field) -> Result<RoleSwapSpec> {
        if let Some((field, message)) = file.policy.fault() {
            return self.fault(&at.key("policy").dotted(&field), message);
        }
        self.timers(&file.timers, &at.key("timers"))?;
        Ok(RoleSwapSpec {
            protocol: file.protocol,
            policy: file.policy.clone(),
            cast: self.cast(&file.cast, &at.key("cast"))?,
            timers: file.timers,
        })
    }

    fn cast(&self, cast: &SwapRolesFile, at: &Field) -> Result<SwapRoles> {
        let halfback = self.role_index(&cast.halfback.name, &at.key("halfback"))?;
        let floater = self.role_index(&cast.floater.name, &at.key("floater"))?;
        let forward = self.role_index(&cast.forward.name, &at.key("forward"))?;
        if halfback == floater || floater == forward || forward == halfback {
            return self.fault(at, "needs three different roles");
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
            return self.fault(&at.key("back_off"), "needs two times, the lesser one first");
        }
        Ok(())
    }
}
