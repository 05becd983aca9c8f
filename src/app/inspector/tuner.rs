//! A value under a person's hand: a slider, a number, and the way back to the value of its file.

use bevy_egui::egui;

use crate::app::view::colours;

/// How a value is shown and changed.
pub struct Tuner<'a> {
    /// The least and the most.
    pub range: (f32, f32),
    /// Steps of the slider; any value if 0.
    pub step: f64,
    pub decimals: usize,
    pub unit: &'a str,
    pub tip: &'a str,
    /// Widths of the slider and of the number, in points.
    pub widths: (f32, f32),
}

/// Width of the button that resets a value, in points.
pub const RESET: f32 = 20.0;
/// Height of a row, in points.
pub const ROW: f32 = 19.0;
/// Values nearer than this share of the range are the same.
const SAME: f32 = 1e-4;

impl Tuner<'_> {
    /// Whether a value is not that of its file.
    pub fn differs(&self, value: f32, filed: f32) -> bool {
        (value - filed).abs() > SAME * (self.range.1 - self.range.0)
    }

    /// Shows the value with its controls from left to right.
    pub fn show(&self, ui: &mut egui::Ui, value: &mut f32, filed: f32) {
        let differs = self.differs(*value, filed);
        self.show_slider(ui, value);
        ui.scope(|ui| {
            if differs {
                ui.visuals_mut().override_text_color = Some(colours::egui(colours::CHANGED));
            }
            self.show_number(ui, value);
        });
        if differs {
            let tip = format!("Reset to the file's {filed:.*}", self.decimals);
            let reset = egui::Button::new("⟲").frame(false);
            if ui.add_sized([RESET, ROW], reset).on_hover_text(tip).clicked() {
                *value = filed;
            }
        }
    }

    fn show_slider(&self, ui: &mut egui::Ui, value: &mut f32) {
        ui.spacing_mut().slider_width = self.widths.0;
        let slider = egui::Slider::new(value, self.range.0..=self.range.1)
            .step_by(self.step)
            .show_value(false)
            .clamping(egui::SliderClamping::Edits);
        let slider = ui.add(slider);
        if slider.drag_stopped() {
            // Otherwise it would keep the keyboard to itself.
            slider.surrender_focus();
        }
        if !slider.dragged() {
            slider.on_hover_text(self.tip);
        }
    }

    fn show_number(&self, ui: &mut egui::Ui, value: &mut f32) {
        let (least, most) = self.range;
        let unit = match self.unit {
            "" => String::new(),
            degrees if degrees.starts_with('°') => degrees.into(),
            unit => format!(" {unit}"),
        };
        let number = egui::DragValue::new(value)
            .range(least..=most)
            .speed((most - least) / 400.0)
            .fixed_decimals(self.decimals)
            .suffix(unit)
            .clamp_existing_to_range(false)
            .update_while_editing(false);
        ui.add_sized([self.widths.1, ROW], number).on_hover_text("Drag, or click to type");
    }
}
