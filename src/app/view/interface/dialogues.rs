//! Questions before something is lost: a restart, and leaving a match that is not over. While it asks, time stands still.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::dock::show_in_the_middle;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::input::keyboard::Keyboard;
use crate::app::view::state::{
    Action, FrameSystems, Inspector, MatchBegun, OpenDialogues, PanelSystems, PendingMatch, Piloted,
    Question, Rewound, Screen, Selected, Session,
};
use crate::app::view::time::asking::AskedWhy;
use crate::clock::Clock;
use crate::ids::Team;
use crate::strategy::Strategies;
use crate::world::referee::{MatchState, Phase};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(close_all)
        .add_observer(close_result)
        .add_systems(Update, (open_and_close, show_result_at_the_end).in_set(FrameSystems::Input))
        .add_systems(
            EguiPrimaryContextPass,
            (ask, show_result).in_set(PanelSystems::Floating).run_if(in_state(Screen::Match)),
        );
}

impl Question {
    /// Question, yes and no.
    fn words(self) -> [&'static str; 3] {
        match self {
            Question::Restart => ["Restart the match? Its score will be lost.", "Restart", "Play on"],
            Question::Leave => ["Leave the match? Its score will be lost.", "Leave", "Play on"],
        }
    }
}

fn close_all(_: On<MatchBegun>, mut open: ResMut<OpenDialogues>) {
    *open = OpenDialogues::default();
}

/// A match that goes back is not over.
fn close_result(_: On<Rewound>, mut open: ResMut<OpenDialogues>) {
    open.result = false;
}

fn open_and_close(
    mut actions: MessageReader<Action>,
    (state, clock): (Res<MatchState>, Res<Clock>),
    (mut open, mut selected, piloted): (ResMut<OpenDialogues>, ResMut<Selected>, Res<Piloted>),
    mut doing: Doing,
) {
    // A scenario is soon played again, so nothing is lost with it.
    let running = state.phase != Phase::Finished && clock.tick > 0 && doing.session.scenario.is_none();
    for action in actions.read() {
        match action {
            Action::Help => open.help = !open.help,
            Action::Restart if running => open.question = Some(Question::Restart),
            Action::Restart => doing.carry_out(Question::Restart),
            Action::Leave if running => open.question = Some(Question::Leave),
            Action::Leave => doing.carry_out(Question::Leave),
            Action::Escape => {
                if open.close_one() || doing.close_window() {
                    continue;
                }
                if selected.0.is_some() && piloted.0.is_none() {
                    selected.0 = None;
                } else if running {
                    open.question = Some(Question::Leave);
                } else {
                    doing.carry_out(Question::Leave);
                }
            }
            _ => {}
        }
    }
}

/// What a yes leads to.
#[derive(bevy::ecs::system::SystemParam)]
struct Doing<'w> {
    pending: ResMut<'w, PendingMatch>,
    session: Res<'w, Session>,
    screen: ResMut<'w, NextState<Screen>>,
    asked: ResMut<'w, AskedWhy>,
    inspector: ResMut<'w, Inspector>,
}

impl Doing<'_> {
    /// Closes one of the windows that float over the pitch; whether there was one.
    fn close_window(&mut self) -> bool {
        if self.asked.is_open() {
            self.asked.close();
            return true;
        }
        std::mem::take(&mut self.inspector.world)
    }

    fn carry_out(&mut self, question: Question) {
        match question {
            Question::Restart => self.pending.0 = Some(self.session.request.clone()),
            Question::Leave => self.screen.set(Screen::Menu),
        }
    }
}

fn ask(mut contexts: EguiContexts, mut open: ResMut<OpenDialogues>, mut doing: Doing) -> Result {
    let Some(question) = open.question else { return Ok(()) };
    let ctx = contexts.ctx_mut()?;
    let [text, yes, no] = question.words();
    let shown = show_in_the_middle(ctx, "Question", |ui| {
        ui.label(egui::RichText::new(text).size(16.0));
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            let yes = ui.button(yes).on_hover_text("Enter").clicked();
            let no = ui.button(no).on_hover_text("Escape").clicked();
            (yes, no)
        })
        .inner
    });
    let (clicked, refused) = shown.unwrap_or_default();
    let confirmed = clicked || ctx.input(|input| input.key_pressed(egui::Key::Enter));
    if confirmed {
        doing.carry_out(question);
    }
    if confirmed || refused {
        open.question = None;
    }
    Ok(())
}

fn show_result_at_the_end(state: Res<MatchState>, mut open: ResMut<OpenDialogues>, mut shown: Local<bool>) {
    let over = state.phase == Phase::Finished;
    if over && !*shown {
        open.result = true;
    }
    *shown = over;
}

fn show_result(
    mut contexts: EguiContexts,
    open: Res<OpenDialogues>,
    (state, strategies, keyboard): (Res<MatchState>, Res<Strategies>, Res<Keyboard>),
    mut actions: MessageWriter<Action>,
) -> Result {
    if !open.result || open.question.is_some() {
        return Ok(());
    }
    let [home, away] = state.score;
    show_in_the_middle(contexts.ctx_mut()?, "Full time", |ui| {
        ui.vertical_centered(|ui| {
            ui.label(egui::RichText::new("Full time").size(16.0));
            ui.label(egui::RichText::new(format!("{home} : {away}")).size(36.0).strong());
            for team in Team::BOTH {
                let name = egui::RichText::new(&strategies.of(team).name).size(16.0);
                ui.label(name.color(paint(colours::team_text(team))));
            }
        });
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            for (text, action) in [("Play again", Action::Restart), ("Menu", Action::Leave)] {
                if ui.button(text).on_hover_text(keyboard.tip(action)).clicked() {
                    actions.write(action);
                }
            }
            if ui.button("Look at the pitch").on_hover_text(keyboard.tip(Action::Escape)).clicked() {
                actions.write(Action::Escape);
            }
        });
    });
    Ok(())
}
