//! A person's hand on an interface without a window: frames with pointer and keys, and what is drawn in them.

use bevy_egui::egui::{
    self, Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, TextureId, Vec2,
};

/// An interface of a size, and the frames that it has shown.
pub struct Hand {
    ctx: egui::Context,
    size: Vec2,
    frames: u32,
}

/// What was drawn: pictures and texts with their places.
#[derive(Default)]
pub struct DrawnFrame {
    pub pictures: Vec<Rect>,
    pub texts: Vec<(String, Rect)>,
}

impl Hand {
    pub fn on(size: Vec2) -> Hand {
        Hand { ctx: egui::Context::default(), size, frames: 0 }
    }

    /// A frame in which a person does this, drawn by that.
    pub fn frame(&mut self, events: Vec<Event>, draw: impl FnOnce(&egui::Context, Rect)) -> DrawnFrame {
        let screen = Rect::from_min_size(Pos2::ZERO, self.size);
        self.frames += 1;
        let time = Some(f64::from(self.frames) / 60.0);
        let modifiers = match events.last() {
            Some(Event::Key { modifiers, .. } | Event::PointerButton { modifiers, .. }) => *modifiers,
            _ => Modifiers::NONE,
        };
        self.ctx.begin_pass(RawInput {
            screen_rect: Some(screen),
            time,
            events,
            modifiers,
            ..RawInput::default()
        });
        draw(&self.ctx, screen);
        let mut drawn = DrawnFrame::default();
        self.ctx.end_pass().shapes.iter().for_each(|clipped| drawn.take(&clipped.shape));
        drawn
    }
}

/// The events of a click, a frame each.
pub fn click(pos: Pos2, button: PointerButton, modifiers: Modifiers) -> [Vec<Event>; 4] {
    let event = |pressed| vec![Event::PointerButton { pos, button, pressed, modifiers }];
    [vec![Event::PointerMoved(pos)], event(true), event(false), Vec::new()]
}

/// A key that is pressed.
pub fn key(key: Key, modifiers: Modifiers) -> Vec<Event> {
    vec![Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }]
}

impl DrawnFrame {
    fn take(&mut self, shape: &Shape) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| self.take(shape)),
            Shape::Text(text) => {
                let rect = text.galley.rect.translate(text.pos.to_vec2());
                self.texts.push((text.galley.text().to_owned(), rect));
            }
            // Letters have the default one.
            Shape::Mesh(mesh) if mesh.texture_id != TextureId::default() => {
                self.pictures.push(mesh.calc_bounds());
            }
            _ => {}
        }
    }

    /// Where a text is.
    pub fn place_of(&self, text: &str) -> Rect {
        let found = self.texts.iter().find(|(shown, _)| shown == text);
        found.map(|(_, place)| *place).unwrap_or_else(|| panic!("there is no {text:?} in {:?}", self.texts))
    }

    /// The middle of a pixel of a picture that is so many pixels wide.
    pub fn pixel(&self, picture: usize, width: usize, (x, y): (usize, usize)) -> Pos2 {
        let rect = self.pictures[picture];
        rect.min + rect.width() / width as f32 * egui::vec2(x as f32 + 0.5, y as f32 + 0.5)
    }
}
