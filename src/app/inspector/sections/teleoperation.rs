//! A person's hands on the robot without keys: a pad to walk on, levers for turn and head, and a button for each kick.

use bevy::prelude::*;
use bevy_egui::egui::{self, RichText};

use super::panel_actions::PanelActions;
use super::{identity, joystick};
use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::format;
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::input::keys::{Deed, DriveKey};
use crate::app::view::input::manual_control::ManualControl;
use crate::clock::Clock;
use crate::robot::handling::Grip;
use crate::robot::{Drive, Kick, RobotKind};

/// Width of a lever, in points.
const LEVER: f32 = 120.0;

pub(super) fn draw(ui: &mut egui::Ui, robot: &SelectedRobot, actions: &mut PanelActions) {
    let body = TeleoperatedBody {
        kind: &robot.of.robot.kind,
        pan: robot.of.head.pan,
        chin: match robot.of.handling.grip {
            Grip::Open => "open",
            Grip::Lowering { .. } => "goes down",
            Grip::Holding { .. } => "holds the ball",
            Grip::Raising { .. } => "missed, goes up",
        },
        holds: robot.of.handling.holds(),
        kicking: robot.of.handling.kicking.map(|kicking| kicking.kick),
    };
    let mine = actions.piloted.0 == Some(robot.id);
    if !mine {
        ui.horizontal(|ui| {
            identity::hand_over(ui, robot.id, actions);
            ui.weak("the robot to work its levers");
        });
    }
    let mut still = ManualControl::default();
    ui.add_enabled_ui(mine, |ui| {
        let control = if mine { &mut *actions.control } else { &mut still };
        body.show_levers(ui, control, actions.keyboard, &robot.clock);
    });
}

/// The robot under a person's hands, as far as its levers show it.
pub struct TeleoperatedBody<'a> {
    pub kind: &'a RobotKind,
    /// Where its head looks, rad to the left.
    pub pan: f32,
    /// What its chin does.
    pub chin: &'a str,
    /// Whether it holds the ball.
    pub holds: bool,
    /// The kick that it is at.
    pub kicking: Option<Kick>,
}

impl TeleoperatedBody<'_> {
    /// Shows the levers.
    pub fn show_levers(
        &self,
        ui: &mut egui::Ui,
        control: &mut ManualControl,
        keyboard: &Keyboard,
        clock: &Clock,
    ) {
        ui.horizontal_top(|ui| {
            walk(ui, self.kind, control);
            ui.add_space(6.0);
            ui.vertical(|ui| {
                speeds(ui, self.kind, control);
                if matches!(self.kind.drive, Drive::Walker(_)) {
                    turn(ui, self.kind, control);
                }
                head(ui, self, control);
                if self.kind.chin.is_some() {
                    hold(ui, self, control, keyboard);
                }
            });
        });
        kicks(ui, self, control, clock);
    }
}

/// The pad. What has wheels turns where what has legs steps aside.
fn walk(ui: &mut egui::Ui, kind: &RobotKind, control: &mut ManualControl) {
    match kind.drive {
        Drive::Walker(_) => joystick::show(ui, &mut control.input.walk, "left and right step aside"),
        Drive::Differential(_) => {
            let mut way = Vec2::new(control.input.walk.x, control.input.turn);
            joystick::show(ui, &mut way, "left and right turn");
            (control.input.walk.x, control.input.turn) = (way.x, way.y);
        }
    }
}

/// What the pad asks for.
fn speeds(ui: &mut egui::Ui, kind: &RobotKind, control: &ManualControl) {
    let Vec2 { x, y } = control.input.walk;
    let (ahead, second) = match kind.drive {
        Drive::Walker(walker) => {
            let ahead = x * if x >= 0.0 { walker.ahead } else { walker.back };
            (ahead, format!("{} to the {}", format::speed(y.abs() * walker.aside), side(y)))
        }
        Drive::Differential(drive) => {
            let turn = control.input.turn;
            let rate = format::fixed(turn.abs() * drive.turn_rate, 0);
            (x * drive.max_speed, format!("{rate}°/s to the {}", side(turn)))
        }
    };
    let way = if ahead >= 0.0 { "ahead" } else { "back" };
    ui.label(format!("{} {way}, {second}", format::speed(ahead.abs())));
}

fn side(left: f32) -> &'static str {
    if left >= 0.0 { "left" } else { "right" }
}

/// A lever that is drawn from left to right, in degrees; positive is left.
fn lever(ui: &mut egui::Ui, name: &str, value: &mut f32, most: f32, unit: &str) -> egui::Response {
    ui.spacing_mut().slider_width = LEVER;
    ui.horizontal(|ui| {
        ui.add_sized([34.0, 18.0], egui::Label::new(name));
        // A slider that rounds would take the rounding for a person's hand.
        *value = value.round();
        let slider = egui::Slider::new(value, most..=-most)
            .fixed_decimals(0)
            .custom_formatter(|value, _| format::fixed(value as f32, 0))
            .suffix(unit.to_owned());
        ui.add(slider)
    })
    .inner
}

fn turn(ui: &mut egui::Ui, kind: &RobotKind, control: &mut ManualControl) {
    let most = kind.max_turn().to_degrees();
    let mut rate = control.input.turn * most;
    let slider = lever(ui, "Turn", &mut rate, most, "°/s");
    control.input.turn = rate / most;
    if slider.drag_stopped() {
        control.input.turn = 0.0;
        // Otherwise it would keep the keyboard to itself.
        slider.surrender_focus();
    }
    if !slider.dragged() {
        slider.on_hover_text(
            "Turns on the spot or while it walks, to the left above zero; springs back when let go",
        );
    }
}

fn head(ui: &mut egui::Ui, body: &TeleoperatedBody, control: &mut ManualControl) {
    let Some(neck) = &body.kind.neck else { return };
    let mut pan = control.head.map_or(body.pan.to_degrees(), |share| share * neck.pan);
    let slider = lever(ui, "Head", &mut pan, neck.pan, "°");
    if slider.changed() {
        control.head = Some(pan / neck.pan);
    }
    if slider.drag_stopped() {
        slider.surrender_focus();
    }
    if !slider.dragged() {
        slider.on_hover_text("Where the head looks, to the left above zero");
    }
    let mut itself = control.head.is_none();
    let tip = "The head follows the ball, or looks for it, as when the robot plays";
    if ui.checkbox(&mut itself, "the head looks for the ball itself").on_hover_text(tip).changed() {
        control.head = (!itself).then_some(pan / neck.pan);
    }
}

fn hold(ui: &mut egui::Ui, body: &TeleoperatedBody, control: &mut ManualControl, keyboard: &Keyboard) {
    let told = body.chin;
    ui.horizontal(|ui| {
        let key = keyboard.key(Deed::Drive(DriveKey::Hold));
        let tip =
            format!("The chin catches the ball when it is before the chest, and keeps it ({key}, held)");
        ui.checkbox(&mut control.input.hold, "hold the ball").on_hover_text(tip);
        ui.weak(format!("the chin: {told}"));
    });
}

fn kicks(ui: &mut egui::Ui, body: &TeleoperatedBody, control: &mut ManualControl, clock: &Clock) {
    let kicks = &body.kind.kicks;
    if kicks.is_empty() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.label("Kick");
        for (number, (name, kick)) in kicks.iter().enumerate() {
            let now = body.kicking.is_some_and(|kicking| kicking == *kick);
            let asked = control.kick_asked() == Some(number);
            let button = egui::Button::new(RichText::new(name.replace('_', " "))).selected(now || asked);
            let possible = !kick.from_hold || body.holds;
            let button = ui.add_enabled(possible, button);
            let button = button.on_hover_text(told(kick)).on_disabled_hover_text(told(kick));
            if button.clicked() {
                control.kick(number, clock);
            }
        }
    });
}

/// A kick in words.
fn told(kick: &Kick) -> String {
    let way = format::aside(kick.direction.to_radians());
    let hold = if kick.from_hold { "; the chin has to hold the ball" } else { "" };
    format!(
        "Sends the ball {way}, {} far, within {}{hold}",
        format::metres(kick.run_out),
        format::seconds(kick.time)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kick_tells_where_how_far_and_what_it_needs() {
        let kick = Kick {
            direction: -75.0,
            run_out: 2.22,
            run_out_spread: 0.0,
            spread: 0.0,
            time: 1.2,
            from_hold: true,
        };
        let words = "Sends the ball 75° right, 2.22 m far, within 1.2 s; the chin has to hold the ball";
        assert_eq!(told(&kick), words);
    }
}
