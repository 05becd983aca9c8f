//! The first thing that a person sees: three cards, of which the first needs no thought.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use egui::{Color32, RichText, vec2};

use super::custom_match::{CustomMatch, fresh_seed};
use super::menu_art::{Picture, paint_picture};
use super::scenario_list::ScenarioList;
use crate::app::match_request::MatchRequest;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::picture::visuals::clear;
use crate::app::view::state::{FileError, Folder, FreeArea, PanelSystems, PendingMatch, Screen};
use crate::app::view::style;
use crate::game::Choice;
use crate::ids::{RobotId, Team};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<CustomMatch>()
        .init_resource::<ScenarioList>()
        .init_resource::<ThirdCard>()
        .add_systems(OnEnter(Screen::Menu), enter)
        .add_systems(
            EguiPrimaryContextPass,
            show_menu.in_set(PanelSystems::Floating).run_if(in_state(Screen::Menu)),
        );
}

/// What the third card shows.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
enum ThirdCard {
    #[default]
    Scenarios,
    CustomMatch,
}

const CARD: egui::Vec2 = vec2(330.0, 330.0);
const GAP: f32 = 20.0;

/// A match with the person at the wheel of a ball chaser.
fn against_the_hammerheads() -> Choice {
    Choice {
        home: Some("ball_chasers".into()),
        away: Some("hammerheads_2001".into()),
        half_minutes: Some(5.0),
        seed: fresh_seed(),
        pilot: Some(RobotId::new(Team::Home, 0)),
        ..Choice::default()
    }
}

/// The friendly match, which a person watches.
fn to_watch() -> Choice {
    Choice { half_minutes: Some(5.0), seed: fresh_seed(), ..Choice::default() }
}

fn enter(world: &mut World) {
    clear(world);
    if let Some(folder) = world.get_resource::<Folder>().cloned() {
        world.resource_mut::<CustomMatch>().refresh(&folder.0);
        world.resource_mut::<ScenarioList>().refresh(&folder.0);
    }
}

/// What the cards show and ask for.
#[derive(SystemParam)]
struct Cards<'w> {
    third: ResMut<'w, ThirdCard>,
    form: ResMut<'w, CustomMatch>,
    scenarios: ResMut<'w, ScenarioList>,
}

fn show_menu(
    mut contexts: EguiContexts,
    area: Res<FreeArea>,
    mut cards: Cards,
    (mut pending, file_error): (ResMut<PendingMatch>, Res<FileError>),
) -> Result {
    let ctx = contexts.ctx_mut()?;
    let place = egui::UiBuilder::new().layer_id(egui::LayerId::background()).max_rect(area.0);
    let mut ui = egui::Ui::new(ctx.clone(), egui::Id::new("menu"), place);
    paint_pitch(ui.painter(), area.0);
    let mut wanted = None;
    egui::ScrollArea::vertical().auto_shrink(false).show(&mut ui, |ui| {
        show_title(ui, area.0.height());
        if let Some(file_error) = file_error.0.as_ref().filter(|_| area.0.height() < ROOMY) {
            show_file_error(ui, file_error);
        }
        wanted = show_cards(ui, &mut cards);
        if let Some(file_error) = file_error.0.as_ref().filter(|_| area.0.height() >= ROOMY) {
            show_file_error(ui, file_error);
        }
    });
    if wanted.is_some() {
        pending.0 = wanted;
    }
    Ok(())
}

/// A window that is lower than this has a small title, and what went wrong above the cards, in points.
const ROOMY: f32 = 600.0;

fn show_title(ui: &mut egui::Ui, height: f32) {
    let (above, size, below) = if height < ROOMY { (8.0, 32.0, 10.0) } else { (0.11 * height, 52.0, 36.0) };
    ui.add_space(above);
    ui.vertical_centered(|ui| {
        ui.label(RichText::new("Touchline").size(size).color(Color32::WHITE));
        ui.label(
            RichText::new("Robot soccer, as in the RoboCup hall of 2001").size(18.0).color(Color32::WHITE),
        );
    });
    ui.add_space(below);
}

/// The three cards, as many beside each other as there is room for.
fn show_cards(ui: &mut egui::Ui, cards: &mut Cards) -> Option<MatchRequest> {
    let room = ui.available_width();
    let columns = (((room + GAP) / (CARD.x + GAP)) as usize).clamp(1, 3);
    let card = CARD.x.min(room).max(1.0);
    let width = columns as f32 * (card + GAP) - GAP;
    let mut wanted = None;
    for row in [0, 1, 2].chunks(columns) {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            ui.add_space(((room - width) / 2.0).max(0.0));
            for number in row {
                wanted = show_card(ui, *number, card, cards).or(wanted.take());
            }
        });
        ui.add_space(GAP - ui.spacing().item_spacing.y);
    }
    wanted
}

fn show_card(ui: &mut egui::Ui, number: usize, width: f32, cards: &mut Cards) -> Option<MatchRequest> {
    let play = "You drive one robot of the home team against the CMU Hammerheads of 2001. Your three team mates \
                chase the ball by themselves.";
    let watch = "The CMU Hammerheads play against a team of ball chasers. Select a robot to see what it senses, \
                 believes and wants, and take it over whenever you like.";
    match number {
        0 => picture_card(ui, width, "Play against the Hammerheads", Picture::Play, play, "Play")
            .then(|| MatchRequest::Match(against_the_hammerheads())),
        1 => picture_card(ui, width, "Watch", Picture::Watch, watch, "Watch")
            .then(|| MatchRequest::Match(to_watch())),
        _ => bare_card(ui, width, |ui| {
            show_tabs(ui, &mut cards.third);
            ui.add_space(6.0);
            match *cards.third {
                ThirdCard::Scenarios => cards.scenarios.show(ui),
                ThirdCard::CustomMatch => cards.form.show(ui).map(MatchRequest::Match),
            }
        }),
    }
}

fn show_file_error(ui: &mut egui::Ui, file_error: &str) {
    ui.vertical_centered(|ui| {
        let frame = style::panel_frame(colours::TROUBLE, egui::Margin::symmetric(12, 8)).corner_radius(6);
        frame.show(ui, |ui| ui.add(egui::Label::new(RichText::new(file_error).color(Color32::WHITE)).wrap()));
    });
    ui.add_space(10.0);
}

/// The titles of the third card, of which one is chosen.
fn show_tabs(ui: &mut egui::Ui, third: &mut ThirdCard) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 16.0;
        for (card, title) in [(ThirdCard::Scenarios, "Scenarios"), (ThirdCard::CustomMatch, "Custom match")] {
            let colour = if *third == card { colours::PILOT } else { colours::QUIET };
            let text = RichText::new(title).size(20.0).color(paint(colour));
            let tab = ui.add(egui::Label::new(text).sense(egui::Sense::click()));
            let tab = tab.on_hover_cursor(egui::CursorIcon::PointingHand);
            if *third == card {
                let line = egui::Stroke::new(2.0, paint(colours::ACCENT));
                ui.painter().hline(tab.rect.x_range(), tab.rect.bottom() + 1.0, line);
            }
            if tab.clicked() {
                *third = card;
            }
        }
    });
}

fn bare_card<R>(ui: &mut egui::Ui, width: f32, contents: impl FnOnce(&mut egui::Ui) -> R) -> R {
    let frame = egui::Frame::new().fill(paint(colours::PANEL)).corner_radius(10).inner_margin(18);
    let inner = (vec2(width, CARD.y) - frame.total_margin().sum()).max(vec2(1.0, 1.0));
    let shown = frame.show(ui, |ui| {
        ui.set_width(inner.x);
        ui.set_height(inner.y);
        let shown = ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            contents(ui)
        });
        shown.inner
    });
    shown.inner
}

/// A card with a title, a picture, a few words and a button; whether that was clicked.
fn picture_card(
    ui: &mut egui::Ui,
    width: f32,
    title: &str,
    picture: Picture,
    text: &str,
    button: &str,
) -> bool {
    bare_card(ui, width, |ui| {
        ui.label(RichText::new(title).size(20.0).color(paint(colours::PILOT)));
        ui.add_space(6.0);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 96.0), egui::Sense::hover());
        paint_picture(ui.painter(), rect, picture);
        ui.add_space(6.0);
        ui.label(RichText::new(text).size(15.0).color(paint(colours::TEXT)));
        ui.with_layout(egui::Layout::bottom_up(egui::Align::Min), |ui| {
            style::big_button(ui, button).clicked()
        })
        .inner
    })
}

/// A pitch to rest the eyes on: stripes, a line and a circle.
fn paint_pitch(painter: &egui::Painter, area: egui::Rect) {
    painter.rect_filled(area, 0.0, paint(colours::CARPET));
    let stripe = area.width() / 12.0;
    for number in (0..12).step_by(2) {
        let left = area.left() + number as f32 * stripe;
        let rect = egui::Rect::from_x_y_ranges(left..=left + stripe, area.y_range());
        painter.rect_filled(rect, 0.0, paint(colours::STRIPE));
    }
    let chalk = egui::Stroke::new(4.0, paint(colours::CARPET).lerp_to_gamma(paint(colours::CHALK), 0.3));
    // Not through the title.
    let inset = if area.height() < ROOMY { 6.0 } else { 24.0 };
    painter.circle_stroke(egui::pos2(area.center().x, area.bottom() - inset), area.height() * 0.16, chalk);
    painter.rect_stroke(area.shrink(inset), 0.0, chalk, egui::StrokeKind::Inside);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AssetFolder;
    use crate::game::MatchPlan;

    #[test]
    fn every_card_leads_to_a_match_that_can_be_played() {
        let assets = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        for choice in [against_the_hammerheads(), to_watch()] {
            assert_eq!(MatchPlan::read(&assets, &choice).map(|plan| plan.pilot), Ok(choice.pilot));
        }
    }
}
