//! The panel below the pitch with the state machine of the selected robot as a chart: the state that the robot is in, since when,
//! how it came there, and under which conditions it goes on.
//!
//! All that it shows follows from the state of the match, so that it is right in a replay, after a rewind and in a fork as well.

mod canvas;
mod coverage;
mod graph;
mod heat;
mod layout;
mod page;
mod side;
mod trail;
mod viewport;

use std::sync::Arc;

use bevy::prelude::*;
use bevy_egui::{EguiPrimaryContextPass, egui};
use coverage::Counts;
use egui::RichText;
use graph::{ChartGraph, Pointed};
use layout::ChartLayout;
use viewport::Viewport;

use super::breakpoints::{BreakpointForm, Breakpoints, OfferedStops, show_page};
use super::low_panel::{LowDock, LowPanel};
use super::subject::{InspectedMatch, SelectedRobot};
use crate::app::view::colours;
use crate::app::view::state::{FileError, Overlay, PanelSystems, Screen, shows};
use crate::comms::messages::TeamMessage;
use crate::comms::tcm::Data;
use crate::ids::RobotId;
use crate::strategy::{StateRef, Strategies, Strategy};

pub(super) fn plugin(app: &mut App) {
    app.add_plugins(coverage::plugin).init_resource::<ChartView>().init_resource::<DrawnChart>().add_systems(
        EguiPrimaryContextPass,
        dock.in_set(PanelSystems::Low).run_if(in_state(Screen::Match).and_then(shows(Overlay::States))),
    );
}

const PANEL: LowPanel = LowPanel {
    overlay: Overlay::States,
    id: "states",
    heights: (200.0, 800.0),
    closes: "Close the chart of states",
};

/// How the chart is looked at.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct ChartView {
    viewport: Viewport,
    /// The machine that is looked at instead of the one that the robot runs.
    machine: Option<usize>,
    /// The state whose ways out are looked at instead of those of the robot's state.
    state: Option<StateRef>,
    /// Whether conditions stand at all lines.
    conditions: bool,
    /// Whose chart it was last.
    robot: Option<RobotId>,
    /// Whether the breakpoints are shown in place of the chart.
    breakpoints: bool,
    /// What the menu is about that a right click has opened.
    menu: Option<Pointed>,
}

impl Default for ChartView {
    fn default() -> ChartView {
        ChartView {
            viewport: Viewport::default(),
            machine: None,
            state: None,
            conditions: true,
            robot: None,
            breakpoints: false,
            menu: None,
        }
    }
}

/// The chart that was laid out last, and for what.
#[derive(Resource, Default)]
struct DrawnChart {
    of: Option<(Arc<Strategy>, usize)>,
    graph: ChartGraph,
    layout: ChartLayout,
}

impl DrawnChart {
    /// Lays the chart of a machine out, unless it is there; whether it is another one.
    fn turn_to(&mut self, strategy: &Arc<Strategy>, machine: usize, ui: &egui::Ui) -> bool {
        let known =
            self.of.as_ref().is_some_and(|(of, index)| Arc::ptr_eq(of, strategy) && *index == machine);
        if known {
            return false;
        }
        let graph = ChartGraph::of(&strategy.machines[machine], machine);
        self.of = Some((strategy.clone(), machine));
        if graph == self.graph {
            return false;
        }
        let font = egui::FontId::proportional(crate::app::view::style::SMALL);
        let measure = |text: &str| {
            ui.painter().layout_no_wrap(text.to_owned(), font.clone(), egui::Color32::WHITE).size()
        };
        self.layout = canvas::sketch(&graph, measure).lay_out();
        self.graph = graph;
        true
    }
}

/// What the panel draws from and changes.
struct ChartPage<'a> {
    view: &'a mut ChartView,
    drawn: &'a mut DrawnChart,
    strategies: &'a Strategies,
    breakpoints: &'a mut Breakpoints,
    form: &'a mut BreakpointForm,
    counts: Counts<'a>,
    error: &'a mut FileError,
}

fn dock(
    mut dock: LowDock,
    scene: InspectedMatch,
    mut view: ResMut<ChartView>,
    mut drawn: ResMut<DrawnChart>,
    (mut breakpoints, mut form): (ResMut<Breakpoints>, ResMut<BreakpointForm>),
    (counts, mut error): (Counts, ResMut<FileError>),
) -> Result {
    let robot = scene.looked();
    // A copy, so that only what a person changes is kept.
    let mut changed = breakpoints.clone();
    let mut page = ChartPage {
        view: &mut view,
        drawn: &mut drawn,
        strategies: &scene.strategies,
        breakpoints: &mut changed,
        form: &mut form,
        counts,
        error: &mut error,
    };
    let shown = dock.show(
        PANEL,
        &mut page,
        |ui, page| page.show_toolbar(ui, robot.as_ref()),
        |ui, page| match &robot {
            _ if page.view.breakpoints => page.show_breakpoints(ui, robot.as_ref()),
            Some(robot) => page.show_chart(ui, robot),
            None => {
                ui.weak("Select a robot to see its state machine: click it, or press Tab");
            }
        },
    );
    breakpoints.set_if_neq(changed);
    shown
}

impl ChartPage<'_> {
    fn show_toolbar(&mut self, ui: &mut egui::Ui, robot: Option<&SelectedRobot>) {
        let Some(robot) = robot else {
            ui.label(RichText::new("States").size(15.0).strong());
            ui.separator();
            self.show_pages(ui);
            return;
        };
        if self.view.robot.replace(robot.id) != Some(robot.id) {
            (self.view.machine, self.view.state) = (None, None);
            self.view.viewport.follows = true;
        }
        let title = RichText::new(format!("States of {}", robot.id)).size(15.0).strong();
        ui.label(title.color(colours::egui(colours::team_text(robot.id.team))));
        ui.separator();
        self.show_pages(ui);
        ui.separator();
        self.show_machines(ui, robot);
        if self.view.breakpoints {
            return;
        }
        ui.separator();
        let follow = ui.selectable_label(self.view.viewport.follows, "Follow");
        if follow.on_hover_text("Moves the chart along with the robot's state").clicked() {
            self.view.viewport.follows = !self.view.viewport.follows;
            self.view.state = None;
        }
        ui.toggle_value(&mut self.view.conditions, "Conditions")
            .on_hover_text("At all lines, or only at those of the state that is looked at");
        ui.separator();
        if let Some(fault) = coverage::show_choice(ui, &mut self.counts.shown) {
            self.error.0 = Some(fault);
        }
    }

    fn show_pages(&mut self, ui: &mut egui::Ui) {
        let count = self.breakpoints.0.iter().filter(|breakpoint| breakpoint.on).count();
        let breakpoints = format!("Breakpoints ({count})");
        for (page, name, tip) in
            [(false, "Chart", "The state machine"), (true, breakpoints.as_str(), "What the match stops at")]
        {
            if ui.selectable_label(self.view.breakpoints == page, name).on_hover_text(tip).clicked() {
                self.view.breakpoints = page;
            }
        }
    }

    fn show_breakpoints(&mut self, ui: &mut egui::Ui, robot: Option<&SelectedRobot>) {
        let strategy = robot.map(|robot| robot.strategy);
        let machine = robot.zip(strategy).map(|(robot, strategy)| &strategy.machines[self.machine(robot)]);
        let offered = OfferedStops {
            robot: robot.map(|robot| robot.id),
            machine: machine.map_or(String::new(), |machine| machine.name.clone()),
            states: machine.map_or(Vec::new(), |machine| {
                machine.all_states().map(|state| machine.name_of(state).to_owned()).collect()
            }),
            features: strategy
                .map_or(Vec::new(), |strategy| strategy.features.by_name.keys().cloned().collect()),
            messages: TeamMessage::TYPES.iter().map(|known| known.name).collect(),
        };
        show_page(ui, self.breakpoints, self.form, &offered);
    }

    /// The machines of the strategy; that of the robot's role is shown until a person wants another.
    fn show_machines(&mut self, ui: &mut egui::Ui, robot: &SelectedRobot) {
        let own = robot.of.activity.machine(robot.strategy);
        let shown = self.machine(robot);
        ui.weak("Machine");
        for (index, machine) in robot.strategy.machines.iter().enumerate() {
            let mut name = RichText::new(&machine.name);
            if index == own {
                name = name.strong();
            }
            let tip = if index == own {
                "The one that the robot runs, by the role that it acts in"
            } else {
                "Another machine of the strategy"
            };
            if ui.selectable_label(index == shown, name).on_hover_text(tip).clicked() {
                self.view.machine = (index != own).then_some(index);
                self.view.state = None;
            }
        }
    }

    fn machine(&self, robot: &SelectedRobot) -> usize {
        let own = robot.of.activity.machine(robot.strategy);
        self.view.machine.filter(|machine| *machine < robot.strategy.machines.len()).unwrap_or(own)
    }
}
