//! Keys become actions, and actions change how time passes and what is open.

use bevy::input::ButtonState;
use bevy::input::keyboard::{Key, KeyboardInput};
use bevy::prelude::*;
use bevy_egui::{EguiContext, EguiContexts, EguiInput, EguiPreUpdateSet, PrimaryEguiContext, egui};

use super::driving::DrivenRobot;
use crate::app::view::state::{
    Action, FrameSystems, Inspector, OpenDialogues, OpenPanels, Overlays, Piloted, Playback,
    RememberedPanels, Screen,
};

pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        PreUpdate,
        keep_tab_from_widgets
            .after(EguiPreUpdateSet::ProcessInput)
            .before(EguiPreUpdateSet::BeginPass)
            .run_if(in_state(Screen::Match)),
    )
    .add_systems(
        Update,
        (
            read_keys.in_set(FrameSystems::Keys),
            (change_playback, open_panels).in_set(FrameSystems::Input),
            remember_panels.in_set(FrameSystems::Time),
        ),
    );
}

/// Tab goes to the next robot in a match, and not to the next button.
fn keep_tab_from_widgets(mut contexts: Query<(&mut EguiContext, &mut EguiInput), With<PrimaryEguiContext>>) {
    for (mut ctx, mut input) in &mut contexts {
        if !ctx.get_mut().egui_wants_keyboard_input() {
            input.0.events.retain(|event| !matches!(event, egui::Event::Key { key: egui::Key::Tab, .. }));
        }
    }
}

fn read_keys(
    mut contexts: EguiContexts,
    held: Res<ButtonInput<KeyCode>>,
    (open, driven): (Res<OpenDialogues>, DrivenRobot),
    mut typed: MessageReader<KeyboardInput>,
    mut actions: MessageWriter<Action>,
) -> Result {
    use KeyCode::{AltLeft, ControlLeft, ControlRight, ShiftLeft, ShiftRight, SuperLeft, SuperRight};
    let ctx = contexts.ctx_mut()?;
    let (elsewhere, is_menu_open) = (ctx.egui_wants_keyboard_input(), egui::Popup::is_any_open(ctx));
    let shift = held.any_pressed([ShiftLeft, ShiftRight]);
    let chord = held.any_pressed([ControlLeft, ControlRight, AltLeft, SuperLeft, SuperRight]);
    for key in typed.read().filter(|key| key.state == ButtonState::Pressed && !elsewhere && !chord) {
        if key.logical_key == Key::Space && driven.kicks() {
            // It kicks, and P pauses.
            continue;
        }
        let Some(action) = Action::of(key, shift) else { continue };
        if action == Action::Escape && is_menu_open {
            // It closes that.
            continue;
        }
        let answers = matches!(action, Action::Escape | Action::Help);
        if (action.repeats() || !key.repeat) && (answers || open.question.is_none()) {
            actions.write(action);
        }
    }
    Ok(())
}

fn change_playback(mut actions: MessageReader<Action>, mut playback: ResMut<Playback>) {
    for action in actions.read() {
        match *action {
            Action::PlayOrPause => playback.paused = !playback.paused,
            Action::OneTick => {
                playback.paused = true;
                playback.single_ticks += 1;
            }
            Action::Faster => playback.faster(),
            Action::Slower => playback.slower(),
            _ => {}
        }
    }
}

fn open_panels(
    mut actions: MessageReader<Action>,
    mut overlays: ResMut<Overlays>,
    mut inspector: ResMut<Inspector>,
) {
    for action in actions.read() {
        match *action {
            Action::Switch(overlay) => overlays.toggle(overlay),
            Action::Inspector => inspector.open = !inspector.open,
            Action::World => inspector.world = !inspector.world,
            _ => {}
        }
    }
}

/// What is open is remembered, and changed when a person begins or ceases to play.
fn remember_panels(
    piloted: Res<Piloted>,
    mut remembered: ResMut<RememberedPanels>,
    (mut overlays, mut inspector): (ResMut<Overlays>, ResMut<Inspector>),
) {
    let mut known = *remembered;
    let open = OpenPanels { overlays: *overlays, inspector: inspector.open };
    if let Some(wanted) = known.follow(open, piloted.0.is_some()) {
        *overlays = wanted.overlays;
        inspector.open = wanted.inspector;
    }
    remembered.set_if_neq(known);
}
