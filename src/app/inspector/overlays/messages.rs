//! Messages on the pitch: a dot travels from sender to receiver between the ticks of sending and arrival, with a line that
//! fades on arrival. The dot of a lost message stops, turns grey and falls.

use bevy::prelude::*;

use super::pens::{Pens, pixel};
use crate::app::inspector::outlines;
use crate::app::inspector::radio::{RadioView, is_of_a_swap, way_of_a_lost_one};
use crate::app::view::colours;
use crate::app::view::picture::visuals::BodyVisual;
use crate::app::view::state::{Overlay, Overlays, Playback};
use crate::clock::Clock;
use crate::comms::radio::{RadioRecord, Transmission, TransmissionState};
use crate::ids::RobotId;

/// How long the line of a message that has arrived fades, and how long a lost one falls, s.
const FADE: f32 = 0.25;
const FALL: f32 = 0.7;
/// How far it falls, m.
const DEPTH: f32 = 0.35;
/// The longest way of a message that is looked for, s.
const LONGEST_WAY: f32 = 4.0;
/// A lost message takes this long to where it is lost, s.
const WAY_TO_LOSS: f32 = 0.05;
/// Radius of a dot and of that of a role swap, in pixels.
const DOT: (f32, f32) = (3.5, 5.0);

/// How a message looks at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Look {
    /// How far it is, 0 to 1.
    Travels(f32),
    /// What is left of its line, 1 to 0.
    Fades(f32),
    /// Where on its way it was lost, and how far it has fallen, 0 to 1.
    Falls { at: f32, by: f32 },
}

/// How a message looks at a time in ticks of `dt` seconds; none if there is nothing to see of it.
fn look(message: &Transmission, now: f64, dt: f32) -> Option<Look> {
    let since = |tick: u64| (now - tick as f64) as f32 * dt;
    let sent = since(message.sent);
    if sent < 0.0 {
        return None;
    }
    match message.state {
        TransmissionState::InFlight(due) | TransmissionState::Arrived(due) => {
            let arrived = since(due);
            if arrived < 0.0 {
                let whole = due.saturating_sub(message.sent).max(1) as f32 * dt;
                Some(Look::Travels((sent / whole).clamp(0.0, 1.0)))
            } else {
                (arrived < FADE).then(|| Look::Fades(1.0 - arrived / FADE))
            }
        }
        TransmissionState::Lost(loss) => {
            let at = way_of_a_lost_one(loss);
            if sent < WAY_TO_LOSS {
                return Some(Look::Travels(at * sent / WAY_TO_LOSS));
            }
            let by = (sent - WAY_TO_LOSS) / FALL;
            (by < 1.0).then_some(Look::Falls { at, by })
        }
    }
}

pub(super) fn draw(
    (overlays, view): (Res<Overlays>, Res<RadioView>),
    (clock, playback, radio): (Res<Clock>, Res<Playback>, Res<RadioRecord>),
    shown: Query<&BodyVisual>,
    camera: Query<(&Camera, &GlobalTransform), With<Camera2d>>,
    mut pens: Pens,
) {
    if !overlays.shows(Overlay::Teamwork) {
        return;
    }
    let pixel = pixel(&camera);
    // Bodies are shown on their way from the tick before the last to the last.
    let now = clock.tick as f64 - 2.0 + f64::from(playback.between);
    let first = now - f64::from(LONGEST_WAY / clock.dt);
    let place_of = |robot: RobotId| {
        shown.iter().find(|shown| shown.robot == Some(robot)).map(|shown| shown.pose.position)
    };
    let recent = radio.transmissions().rev().take_while(|message| message.sent as f64 >= first);
    for message in recent.filter(|message| view.filter.passes(message)) {
        let Some(look) = look(message, now, clock.dt) else { continue };
        let packet = &message.packet;
        let (Some(from), Some(to)) = (place_of(packet.from), place_of(packet.to)) else { continue };
        let tint = colours::team_text(packet.from.team);
        let radius = if is_of_a_swap(packet.kind) { DOT.1 } else { DOT.0 };
        match look {
            Look::Travels(share) => {
                let at = from.lerp(to, share);
                pens.fine.line_2d(from, at, tint.with_alpha(0.5));
                dot(&mut pens, at, radius * pixel, tint);
            }
            Look::Fades(left) => {
                pens.fine.line_2d(from, to, tint.with_alpha(0.6 * left));
                let there = to - 0.3 * (to - from).normalize_or_zero();
                dot(&mut pens, there, radius * pixel, tint.with_alpha(left));
            }
            Look::Falls { at, by } => {
                let at = from.lerp(to, at);
                let grey = colours::LOST.with_alpha(1.0 - by);
                pens.fine.line_2d(from, at, grey.with_alpha(0.5 * (1.0 - by)));
                dot(&mut pens, at - Vec2::Y * DEPTH * by * by, radius * pixel, grey);
            }
        }
    }
}

fn dot(pens: &mut Pens, at: Vec2, radius: f32, tint: Color) {
    for ring in outlines::rings(radius, radius / 2.0) {
        pens.strong.circle_2d(at, ring, tint).resolution(12);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comms::radio::{Loss, Packet};
    use crate::comms::tcm::DataType;
    use crate::ids::Team;

    const DT: f32 = 0.01;

    fn looks(state: TransmissionState, now: f64) -> Option<Look> {
        let (from, to) = (RobotId::new(Team::Home, 1), RobotId::new(Team::Home, 2));
        let packet = Packet { kind: DataType::LOCK, from, to, bytes: [].into() };
        let message = Transmission { id: 0, packet, sent: 100, state, late: false, doubled: false };
        look(&message, now, DT)
    }

    #[test]
    fn a_message_travels_between_the_ticks_and_fades_where_it_arrived() {
        for state in [TransmissionState::Arrived(104), TransmissionState::InFlight(104)] {
            assert_eq!(looks(state, 99.0), None);
            assert_eq!(looks(state, 101.0), Some(Look::Travels(0.25)));
            assert_eq!(looks(state, 104.0), Some(Look::Fades(1.0)));
            assert_eq!(looks(state, 130.0), None);
        }
    }

    #[test]
    fn a_lost_message_falls_where_it_was_lost() {
        let lost = |loss, now| looks(TransmissionState::Lost(loss), now);
        assert!(matches!(lost(Loss::Chance, 102.0), Some(Look::Travels(share)) if share < 0.5));
        assert!(matches!(lost(Loss::Chance, 110.0), Some(Look::Falls { at, .. }) if at == 0.5));
        assert!(matches!(lost(Loss::Deaf, 110.0), Some(Look::Falls { at, .. }) if at > 0.5));
        assert_eq!(lost(Loss::Chance, 200.0), None);
    }
}
