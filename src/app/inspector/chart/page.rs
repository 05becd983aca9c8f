//! The page with the chart itself: what a person points at, clicks and moves on it.

use bevy_egui::egui::{self, vec2};

use super::canvas::{ChartScene, Marks};
use super::graph::{ChartGraph, Pointed};
use super::heat::times;
use super::{ChartPage, ChartView, DrawnChart, side, trail};
use crate::app::inspector::breakpoints::{Breakpoints, StopAt};
use crate::app::inspector::subject::SelectedRobot;
use crate::app::view::colours;
use crate::ids::RobotId;
use crate::ops;
use crate::strategy::StateRef;

/// Width of the lists beside the chart, which are left out where the chart would be narrower than this, in points.
const SIDE: f32 = 330.0;
const NARROWEST: f32 = 380.0;
/// How much a point of the wheel zooms.
const WHEEL: f32 = 0.004;

impl ChartPage<'_> {
    pub(super) fn show_chart(&mut self, ui: &mut egui::Ui, robot: &SelectedRobot) {
        let machine = self.machine(robot);
        if self.drawn.turn_to(&self.strategies.0[robot.id.team.index()], machine, ui) {
            self.view.viewport.begin();
            self.view.state = None;
        }
        let room = ui.available_size();
        let width = if room.x - SIDE >= NARROWEST { room.x - SIDE } else { room.x };
        let drawn = &*self.drawn;
        let mut scene = scene_of(robot, drawn, machine, (&*self.view, &*self.breakpoints));
        scene.heat = self.counts.heat(robot.id.team, &drawn.graph);
        let clicked = ui.horizontal_top(|ui| {
            let clicked = show_canvas(
                ui,
                vec2(width, room.y),
                &scene,
                (robot.id, &mut *self.view, &mut *self.breakpoints),
            );
            let listed = (width < room.x)
                .then(|| ui.vertical(|ui| side::show(ui, robot, &scene, &mut *self.breakpoints)).inner)
                .flatten();
            clicked.or(listed)
        });
        if let Some(state) = clicked.inner.and_then(|at| drawn.graph.boxes.get(at)) {
            self.view.state = Some(state.state);
        }
    }
}

fn scene_of<'a>(
    robot: &SelectedRobot,
    drawn: &'a DrawnChart,
    machine: usize,
    (view, breakpoints): (&ChartView, &Breakpoints),
) -> ChartScene<'a> {
    let (graph, activity) = (&drawn.graph, robot.of.activity);
    let is_own = machine == activity.machine(robot.strategy);
    let current = graph.find(StateRef::Plain(activity.state)).filter(|_| is_own);
    let since = [activity.since].into_iter().chain(activity.entered.iter().rev().copied());
    let lit = current.into_iter().flat_map(|at| graph.with_surroundings(at)).zip(since);
    ChartScene {
        graph,
        layout: &drawn.layout,
        lit: lit.map(|(at, tick)| (at, robot.since(tick))).collect(),
        trail: if is_own { trail::trail(activity, graph, &robot.clock) } else { Vec::new() },
        looked: view.state.and_then(|state| graph.find(state)).or(current).unwrap_or(graph.start),
        conditions: view.conditions,
        heat: None,
        marks: marks(graph, robot.id, breakpoints),
    }
}

/// Where the chart of a robot has breakpoints.
fn marks(graph: &ChartGraph, robot: RobotId, breakpoints: &Breakpoints) -> Marks {
    let of_box = |at| breakpoints.mark(robot, |known| *known == graph.stop(Pointed::Box(at)));
    let of_line = |line| {
        breakpoints.mark(robot, |known| match (known, graph.stop(Pointed::Line(line))) {
            // Those of a single condition as well.
            (
                StopAt::Transition { machine, from, go, .. },
                StopAt::Transition { machine: m, from: f, go: g, .. },
            ) => (machine, from, go) == (&m, &f, &g),
            _ => false,
        })
    };
    Marks {
        boxes: (0..graph.boxes.len()).map(of_box).collect(),
        lines: (0..graph.lines.len()).map(of_line).collect(),
    }
}

/// Shows the chart itself; the box that a person clicks.
fn show_canvas(
    ui: &mut egui::Ui,
    size: egui::Vec2,
    scene: &ChartScene,
    (robot, view, breakpoints): (RobotId, &mut ChartView, &mut Breakpoints),
) -> Option<usize> {
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::CLICK | egui::Sense::DRAG);
    let followed = scene.lit.first().map(|(at, _)| scene.layout.boxes[*at]);
    let seen = view.viewport.project(rect, scene.layout.size, followed);
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 3.0, colours::egui(colours::SUNKEN));
    let pointed = response.hover_pos().and_then(|at| scene.pointed(&seen, at));
    scene.paint(&painter, &seen, pointed);
    if response.dragged() {
        view.viewport.pan(response.drag_delta());
    }
    if response.double_clicked() {
        view.viewport.fit(rect, scene.layout.size);
    }
    if let Some(pointer) = response.hover_pos() {
        let wheel = ui.input_mut(|input| std::mem::take(&mut input.smooth_scroll_delta).y);
        if wheel != 0.0 {
            view.viewport.zoom(ops::exp(wheel * WHEEL), pointer, &seen);
        }
    }
    if response.secondary_clicked() {
        view.menu = pointed;
    }
    if let Some(about) = view.menu.filter(|about| scene.graph.has(*about)) {
        response.context_menu(|ui| show_menu(ui, &scene.graph.stop(about), robot, breakpoints));
    }
    let clicked = response.clicked();
    if let Some(told) = pointed.map(|pointed| told(scene, pointed)) {
        response.on_hover_text_at_pointer(told);
    }
    match pointed {
        Some(Pointed::Box(at)) if clicked => Some(at),
        _ => None,
    }
}

/// What a right click offers.
fn show_menu(ui: &mut egui::Ui, at: &StopAt, robot: RobotId, breakpoints: &mut Breakpoints) {
    for (who, name) in [(Some(robot), robot.to_string()), (None, "any robot".to_owned())] {
        if ui.button(format!("Stop when {name} {at}")).clicked() {
            breakpoints.set(who, at.clone());
            ui.close();
        }
    }
    let is_set = breakpoints.mark(robot, |known| known == at).is_some();
    if is_set && ui.button("Remove the breakpoint").clicked() {
        breakpoints.remove(robot, at);
        ui.close();
    }
}

/// All that there is to tell of a box or a line.
fn told(scene: &ChartScene, pointed: Pointed) -> String {
    let name = |at: usize| scene.graph.boxes[at].name.as_str();
    match pointed {
        Pointed::Box(at) => {
            let ways = scene.graph.ways_out(at);
            let ways =
                ways.iter().map(|(way, to)| format!("\n{}  {} › {}", way.place(), way.when, name(*to)));
            format!("{}{}", name(at), ways.collect::<String>())
        }
        Pointed::Line(number) => {
            let line = &scene.graph.lines[number];
            if line.ways.is_empty() {
                return format!("{} begins in {}", name(line.from), name(line.to));
            }
            let ways = line.ways.iter().map(|way| format!("\n{}  {}", way.place(), way.when));
            let counted = scene.heat.as_ref().map(|heat| format!("\ntaken {}", times(heat.lines[number])));
            let head = format!("{} › {}", name(line.from), name(line.to));
            format!("{head}{}{}", ways.collect::<String>(), counted.unwrap_or_default())
        }
    }
}
