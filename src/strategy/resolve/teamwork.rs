//! The `teamwork` section: roles looked up, numbers checked.

use struct_patch::Patch;

use crate::data::{DataError, Field, Source, Validate, no_such};
use crate::protocol::policy::SwapRoles;
use crate::protocol::role_swap::RoleIndex;
use crate::strategy::teamwork::{
    BallBooking, MapFusion, Mechanism, Mechanisms, MessageTiming, RoleSwapFile, RoleSwapSpec, SwapRolesFile,
    TeamWatch, TeammatesBy, Teamwork, TeamworkFile, Timers,
};

/// The names of a strategy's roles in their order, and the text in which they are looked up.
pub(in crate::strategy) struct Roles<'a> {
    pub names: Vec<&'a str>,
    pub source: &'a Source,
}

impl Roles<'_> {
    /// The section that the text has at `at`.
    pub(in crate::strategy) fn teamwork(
        &self,
        file: &TeamworkFile,
        at: &Field,
    ) -> Result<Teamwork, DataError> {
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
        self.source.locate(&at.key("talk"), talk.validate())?;
        let mut global_map = MapFusion::default();
        global_map.apply(file.global_map);
        self.source.locate(&at.key("global_map"), global_map.validate())?;
        let mut watch = TeamWatch::default();
        watch.apply(file.watch);
        self.source.locate(&at.key("watch"), watch.validate())?;
        let role_swap = file.role_swap.as_ref().map(|swap| self.role_swap(swap, &at.key("role_swap")));
        let mut ball_booking = None;
        if let Some(file) = file.ball_booking {
            let booking = ball_booking.insert(BallBooking::default());
            booking.apply(file);
            self.source.locate(&at.key("ball_booking"), booking.validate())?;
        }
        let mut action_arbitration = file.action_arbitration;
        if let Some(rules) = &action_arbitration {
            self.source.locate(&at.key("action_arbitration"), rules.validate())?;
        }
        if mechanisms.has(Mechanism::ActionArbitration) {
            action_arbitration.get_or_insert_default();
            if mechanisms.has(Mechanism::RoleSwap) {
                let message =
                    "ActionArbitration and RoleSwap broadcast different values: a team has one of them";
                return Err(self.source.error_at(&at.key("mechanisms"), message));
            }
        }
        Ok(Teamwork {
            mechanisms,
            teammates_by: file.teammates_by.unwrap_or_default(),
            supports_by: file.supports_by.unwrap_or(TeammatesBy::Messages),
            ranks,
            goalie,
            talk,
            watch,
            role_swap: role_swap.transpose()?.filter(|_| mechanisms.has(Mechanism::RoleSwap)),
            ball_booking: ball_booking.filter(|_| mechanisms.has(Mechanism::BallBooking)),
            global_map,
            action_arbitration: action_arbitration.filter(|_| mechanisms.has(Mechanism::ActionArbitration)),
        })
    }

    /// The place of a role, by its name.
    pub(super) fn index(&self, name: &str, at: &Field) -> Result<RoleIndex, DataError> {
        let Some(index) = self.names.iter().position(|role| *role == name) else {
            return Err(self.source.error_at(at, no_such("role", name, &self.names)));
        };
        RoleIndex::try_from(index).map_err(|_| self.source.error_at(at, "a strategy has 256 roles at most"))
    }

    fn role_swap(&self, file: &RoleSwapFile, at: &Field) -> Result<RoleSwapSpec, DataError> {
        let protocol = self.source.required(&file.protocol, at, "protocol")?;
        let policy = self.source.required(&file.policy, at, "policy")?;
        let cast = self.source.required(&file.cast, at, "cast")?;
        self.source.locate(&at.key("policy"), policy.validate())?;
        let mut timers = Timers::default();
        timers.apply(file.timers);
        self.source.locate(&at.key("timers"), timers.validate())?;
        Ok(RoleSwapSpec { protocol, policy, cast: self.cast(&cast, &at.key("cast"))?, timers })
    }

    fn cast(&self, cast: &SwapRolesFile, at: &Field) -> Result<SwapRoles, DataError> {
        let halfback = self.index(&cast.halfback.name, &at.key("halfback"))?;
        let floater = self.index(&cast.floater.name, &at.key("floater"))?;
        let forward = self.index(&cast.forward.name, &at.key("forward"))?;
        if halfback == floater || floater == forward || forward == halfback {
            return Err(self.source.error_at(at, "needs three different roles"));
        }
        Ok(SwapRoles { halfback, floater, forward })
    }
}
