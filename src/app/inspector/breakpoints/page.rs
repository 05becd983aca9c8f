//! The list of breakpoints, and a row in which one is put together.

use bevy::prelude::Resource;
use bevy_egui::egui::{self, RichText};

use super::breakpoint::{MessageEvent, StopAt, WhistleKind};
use super::list::Breakpoints;
use crate::app::view::colours;
use crate::ids::RobotId;

/// What a person is putting together.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct BreakpointForm {
    kind: StopKind,
    /// For the selected robot only.
    only_selected: bool,
    state: String,
    feature: String,
    message: String,
    event: Option<MessageEvent>,
    whistle: Option<WhistleKind>,
}

/// Which kind of breakpoint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum StopKind {
    #[default]
    State,
    Feature,
    Message,
    Whistle,
}

impl StopKind {
    const ALL: [(StopKind, &'static str); 4] = [
        (StopKind::State, "comes to a state"),
        (StopKind::Feature, "finds that a feature holds"),
        (StopKind::Message, "sends or gets a message"),
        (StopKind::Whistle, "is whistled at"),
    ];
}

/// What breakpoints can be about now.
pub struct OfferedStops {
    /// The selected robot.
    pub robot: Option<RobotId>,
    /// The machine that is looked at, and its states.
    pub machine: String,
    pub states: Vec<String>,
    /// The features of the strategy.
    pub features: Vec<String>,
    /// The kinds of messages.
    pub messages: Vec<&'static str>,
}

/// Shows all breakpoints and lets a person add, disable and remove them.
pub fn show_page(
    ui: &mut egui::Ui,
    breakpoints: &mut Breakpoints,
    form: &mut BreakpointForm,
    offered: &OfferedStops,
) {
    show_form(ui, breakpoints, form, offered);
    ui.separator();
    if breakpoints.0.is_empty() {
        ui.weak("No breakpoint yet. A right click on a state or a line of the chart sets one, too");
    }
    let mut removed = None;
    for (place, breakpoint) in breakpoints.0.iter_mut().enumerate() {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 8.0;
            let colour = if breakpoint.on { colours::BREAKPOINT } else { colours::QUIET };
            let words = RichText::new(breakpoint.to_string());
            let tip = "Whether the match stops there";
            ui.push_id(place, |ui| {
                ui.label(RichText::new("⏺").color(colours::egui(colour)));
                ui.checkbox(&mut breakpoint.on, words).on_hover_text(tip);
                if ui.small_button("Remove").clicked() {
                    removed = Some(place);
                }
            });
        });
    }
    if let Some(place) = removed {
        breakpoints.0.remove(place);
    }
}

fn show_form(
    ui: &mut egui::Ui,
    breakpoints: &mut Breakpoints,
    form: &mut BreakpointForm,
    offered: &OfferedStops,
) {
    ui.horizontal_wrapped(|ui| {
        ui.label("Stop when");
        let robot = offered.robot.filter(|_| form.only_selected);
        let who = robot.map_or("any robot".to_owned(), |robot| robot.to_string());
        egui::ComboBox::from_id_salt("who").selected_text(who).show_ui(ui, |ui| {
            ui.selectable_value(&mut form.only_selected, false, "any robot");
            if let Some(robot) = offered.robot {
                ui.selectable_value(&mut form.only_selected, true, robot.to_string());
            }
        });
        choose(ui, "kind", 190.0, &mut form.kind, &StopKind::ALL);
        let at = form.show_values(ui, offered);
        let add = ui.add_enabled(at.is_some(), egui::Button::new("Add"));
        if let Some(at) = at.filter(|_| add.clicked()) {
            breakpoints.set(robot, at);
        }
    });
}

impl BreakpointForm {
    /// What the kind that was chosen needs besides; what that comes to.
    fn show_values(&mut self, ui: &mut egui::Ui, offered: &OfferedStops) -> Option<StopAt> {
        match self.kind {
            StopKind::State => {
                name(ui, "state", &mut self.state, offered.states.iter().map(String::as_str));
                let (machine, state) = (offered.machine.clone(), self.state.clone());
                offered.states.contains(&state).then_some(StopAt::State { machine, state })
            }
            StopKind::Feature => {
                name(ui, "feature", &mut self.feature, offered.features.iter().map(String::as_str));
                offered.features.contains(&self.feature).then(|| StopAt::Feature(self.feature.clone()))
            }
            StopKind::Message => {
                name(ui, "message", &mut self.message, offered.messages.iter().copied());
                let mut event = self.event.unwrap_or(MessageEvent::Sent);
                let events = MessageEvent::ALL.map(|event| (event, event.words()));
                choose(ui, "event", 90.0, &mut event, &events);
                self.event = Some(event);
                let is_known = offered.messages.contains(&self.message.as_str());
                is_known.then(|| StopAt::Message { kind: self.message.clone(), event })
            }
            StopKind::Whistle => {
                let kinds = WhistleKind::ALL.map(|kind| (Some(kind), kind.words()));
                let all: Vec<_> = [(None, "for anything")].into_iter().chain(kinds).collect();
                choose(ui, "whistle", 190.0, &mut self.whistle, &all);
                Some(StopAt::Whistle(self.whistle))
            }
        }
    }
}

/// Lets a person choose one of a few values.
fn choose<T: Copy + PartialEq>(ui: &mut egui::Ui, id: &str, width: f32, value: &mut T, all: &[(T, &str)]) {
    let shown = all.iter().find(|(known, _)| known == value).map_or("", |(_, words)| *words);
    egui::ComboBox::from_id_salt(id).width(width).selected_text(shown).show_ui(ui, |ui| {
        for (known, words) in all {
            ui.selectable_value(value, *known, *words);
        }
    });
}

/// Lets a person choose a name.
fn name<'a>(ui: &mut egui::Ui, id: &str, value: &mut String, all: impl Iterator<Item = &'a str>) {
    let shown = if value.is_empty() { "choose" } else { value.as_str() }.to_owned();
    egui::ComboBox::from_id_salt(id).width(190.0).selected_text(shown).show_ui(ui, |ui| {
        for known in all {
            ui.selectable_value(value, known.to_owned(), known);
        }
    });
}
