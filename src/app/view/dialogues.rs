//! Questions before something is lost: a restart, and leaving a match that is not over. While it asks, time stands still.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

use super::FrameSystems;
use super::actions::Action;
use super::colours::{self, egui as paint};
use super::keys::Keyboard;
use super::layout::PanelSystems;
use super::session::{MatchBegun, Session, Wish};
use super::state::{Piloted, Screen, Selected};
use crate::clock::Clock;
use crate::ids::Team;
use crate::strategy::Strategies;
use crate::world::referee::{MatchState, Phase};

pub(super) fn plugin(app: &mut App) {
    app.add_observer(close_all)
        .add_systems(Update, (open_and_close, show_result_at_the_end).in_set(FrameSystems::Input))
        .add_systems(
            EguiPrimaryContextPass,
            (ask, show_result).in_set(PanelSystems::Floating).run_if(in_state(Screen::Match)),
        );
}

/// What lies over the pitch.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Open {
    pub question: Option<Question>,
    pub help: bool,
    /// The final score.
    pub result: bool,
}

/// What is asked before it is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    Restart,
    Leave,
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

impl Open {
    /// Closes the uppermost thing; whether there was one.
    fn close_one(&mut self) -> bool {
        let open = [self.question.take().is_some(), self.help, self.result];
        match open {
            [true, ..] => true,
            [_, true, _] => std::mem::take(&mut self.help),
            [.., result] => {
                self.result = false;
                result
            }
        }
    }
}

fn close_all(_: On<MatchBegun>, mut open: ResMut<Open>) {
    *open = Open::default();
}

fn open_and_close(
    mut actions: MessageReader<Action>,
    (state, clock): (Res<MatchState>, Res<Clock>),
    (mut open, mut selected, piloted): (ResMut<Open>, ResMut<Selected>, Res<Piloted>),
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
                if open.close_one() {
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
    wish: ResMut<'w, Wish>,
    session: Res<'w, Session>,
    screen: ResMut<'w, NextState<Screen>>,
}

impl Doing<'_> {
    fn carry_out(&mut self, question: Question) {
        match question {
            Question::Restart => self.wish.0 = Some(self.session.wanted.clone()),
            Question::Leave => self.screen.set(Screen::Menu),
        }
    }
}

/// Room around what is shown in the middle, to the edges of the screen, in points.
const AROUND: f32 = 44.0;
/// The widest that it becomes, in points.
const WIDEST: f32 = 880.0;

/// Shows something in the middle of the window that is not moved about and scrolls where it does not fit.
pub fn show_in_the_middle<R>(
    ctx: &egui::Context,
    title: &str,
    contents: impl FnOnce(&mut egui::Ui) -> R,
) -> Option<R> {
    let room = (ctx.content_rect().size() - egui::Vec2::splat(AROUND)).max(egui::Vec2::splat(1.0));
    let shown = egui::Window::new(title.to_owned())
        .pivot(egui::Align2::CENTER_CENTER)
        .fixed_pos(ctx.content_rect().center())
        .title_bar(false)
        .collapsible(false)
        .auto_sized()
        .constrain(true)
        .order(egui::Order::Foreground)
        .show(ctx, |ui| {
            ui.set_max_width(room.x.min(WIDEST));
            let scroll = egui::ScrollArea::both()
                .max_width(room.x)
                .max_height(room.y)
                .min_scrolled_width(room.x)
                .min_scrolled_height(room.y);
            scroll.show(ui, contents).inner
        });
    shown.and_then(|shown| shown.inner)
}

fn ask(mut contexts: EguiContexts, mut open: ResMut<Open>, mut doing: Doing) -> Result {
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

fn show_result_at_the_end(state: Res<MatchState>, mut open: ResMut<Open>, mut shown: Local<bool>) {
    let over = state.phase == Phase::Finished;
    if over && !*shown {
        open.result = true;
    }
    *shown = over;
}

fn show_result(
    mut contexts: EguiContexts,
    open: Res<Open>,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escape_closes_one_thing_at_a_time_from_the_top() {
        let mut open = Open { question: Some(Question::Leave), help: true, result: true };
        assert!(open.close_one());
        assert_eq!(open, Open { question: None, help: true, result: true });
        assert!(open.close_one() && open.close_one());
        assert_eq!(open, Open::default());
        assert!(!open.close_one());
    }
}
