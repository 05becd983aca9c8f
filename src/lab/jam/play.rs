//! One play of a match whose radio is made worse.

use std::collections::BTreeMap;

use bevy::prelude::*;

use super::plan::JamPlan;
use super::search::{Interfered, Jammed};
use crate::comms::radio::{FaultRules, RadioRecord, Transmission};
use crate::comms::tcm::DataType;
use crate::game::Match;
use crate::game::requests::Requests;
use crate::ids::{RobotId, Team};

impl JamPlan {
    /// What comes of it if these packets are interfered with.
    pub(super) fn play(&self, set: &[Interfered]) -> Jammed {
        let mut game = self.begin();
        let mut faults = game.world_mut().resource_mut::<FaultRules>();
        self.rules(set).into_iter().for_each(|rule| faults.add(rule));
        let (before, mut jammed) = (self.choice.harm.count(&game), Jammed::default());
        for _ in self.ticks.clone() {
            game.tick();
            if self.choice.harm.count(&game) > before {
                jammed.harmed = Some(game.clock().tick);
                break;
            }
            let home = Team::Home.index();
            let (cover, bookings) = (&game.record().role_cover[home], &game.record().bookings[home]);
            jammed.severity = jammed.severity.max(cover.doubled.now).max(bookings.several_go.now);
        }
        jammed.packets = self.packets(game.world().resource::<RadioRecord>(), set.last());
        jammed
    }

    /// A match that stands where the search begins.
    fn begin(&self) -> Match {
        let mut game = Match::new(&self.plan);
        if let Some(snapshot) = &self.snapshot {
            let restored = snapshot.restore(game.world_mut());
            debug_assert!(restored.is_ok(), "the snapshot is of a match with this very plan");
            game.world_mut().resource_mut::<Requests>().clear();
        }
        game
    }

    /// The packets of home that were sent after the last one that was interfered with, each with all that may be done to it.
    fn packets(&self, radio: &RadioRecord, last: Option<&Interfered>) -> Vec<Interfered> {
        let mut counts: BTreeMap<(DataType, RobotId, RobotId), u32> = BTreeMap::new();
        let (mut packets, mut is_later) = (Vec::new(), last.is_none());
        let sent = |transmission: &&Transmission| transmission.sent >= self.ticks.start;
        for Transmission { packet, sent, .. } in radio.transmissions().filter(sent) {
            let count = counts.entry((packet.kind, packet.from, packet.to)).or_default();
            *count += 1;
            let (kind, from, to, nth, sent) = (packet.kind, packet.from, packet.to, *count, *sent);
            if let Some(last) = last.filter(|_| !is_later) {
                is_later = (kind, from, to, nth) == (last.kind, last.from, last.to, last.nth);
                continue;
            }
            let is_step = packet.message().is_some_and(|message| message.is_step());
            if from.team == Team::Home && (is_step || self.choice.all_kinds) {
                let interfered = |act| Interfered { kind, from, to, nth, act, sent };
                packets.extend(self.choice.acts.iter().copied().map(interfered));
            }
        }
        packets
    }
}
