//! What the panel may ask for, and what it shows of that.

use bevy_egui::egui;

use crate::app::inspector::numbers::NumberDesk;
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::input::manual_control::ManualControl;
use crate::app::view::state::{Action, OpenPanels, Piloted};
use crate::game::requests::Requests;
use crate::game::{MatchPlan, TeamPlan};
use crate::ids::Team;
use crate::strategy::StrategySources;

/// What the panel may ask for, and what it shows of that.
pub struct PanelActions<'a> {
    pub requests: &'a mut Requests,
    pub piloted: &'a mut Piloted,
    pub control: &'a mut ManualControl,
    /// What the files say.
    pub plan: Option<&'a MatchPlan>,
    pub numbers: &'a mut NumberDesk,
    /// What the running strategies were read from.
    pub sources: &'a StrategySources,
    /// Whether the panel is open.
    pub open: &'a mut bool,
    /// What is open while a person drives.
    pub playing: &'a mut OpenPanels,
    pub keyboard: &'a Keyboard,
}

impl PanelActions<'_> {
    /// What the files say of a team.
    pub fn file(&self, team: Team) -> Option<&TeamPlan> {
        self.plan.map(|plan| plan.team(team))
    }
}

/// The button that closes the panel.
pub fn close_button(ui: &mut egui::Ui, actions: &mut PanelActions) {
    let close = ui.add(egui::Button::new("⏵").frame(false));
    let tip = actions.keyboard.tip_that_says("Close the inspector", Action::Inspector);
    if close.on_hover_text(tip).clicked() {
        *actions.open = false;
    }
}
