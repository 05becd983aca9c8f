//! The pictures: the image, the same cut into classes, and the blobs over it, each enlarged so that one can point at a pixel.

use bevy_egui::egui::{
    self, Align2, Color32, ColorImage, Pos2, Rect, Sense, Stroke, TextureHandle, TextureOptions, Vec2, pos2,
    vec2,
};

use super::seen::SeenThing;
use crate::app::view::colours;
use crate::app::view::style::SMALL;
use crate::vision::{ColourBlob, ColourClass, Image, PixelBox};

/// One of the pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureKind {
    /// As the camera gives it.
    Image,
    /// Each pixel in the colour of its class.
    Classes,
    /// With what was recognised.
    Blobs,
}

impl PictureKind {
    /// All of them, from the left, each with its title and what it shows.
    pub const ALL: [(PictureKind, &'static str, &'static str); 3] = [
        (PictureKind::Image, "Image", "The picture as the camera gives it"),
        (PictureKind::Classes, "Classes", "Each pixel in the colour of its class; dark ones are of none"),
        (PictureKind::Blobs, "Blobs", "What was found in the picture, and what it was taken for"),
    ];
}

/// The pictures as textures, made anew when what they show has changed.
#[derive(Clone, Default)]
pub struct PictureTextures {
    image: Option<(Image, TextureHandle)>,
    classes: Option<(Vec<Option<ColourClass>>, TextureHandle)>,
}

impl PictureTextures {
    /// Makes textures of a picture and the classes of its pixels.
    pub fn follow(&mut self, ctx: &egui::Context, image: &Image, classes: &[Option<ColourClass>]) {
        let size = [image.width, image.height];
        if !self.image.as_ref().is_some_and(|(known, _)| known == image) {
            let pixels = image.pixels.iter().map(|pixel| {
                let [red, green, blue] = pixel.to_rgb();
                Color32::from_rgb(red, green, blue)
            });
            let texture = texture(ctx, "camera image", size, pixels.collect());
            self.image = Some((image.clone(), texture));
        }
        if !self.classes.as_ref().is_some_and(|(known, texture)| known == classes && texture.size() == size) {
            let palette = ColourClass::ALL.map(|class| colours::egui(colours::class(class)));
            let none = colours::egui(colours::SUNKEN);
            let pixels = classes.iter().map(|class| class.map_or(none, |class| palette[class.index()]));
            let texture = texture(ctx, "camera classes", size, pixels.collect());
            self.classes = Some((classes.to_vec(), texture));
        }
    }

    fn of(&self, kind: PictureKind) -> Option<&TextureHandle> {
        match kind {
            PictureKind::Image | PictureKind::Blobs => self.image.as_ref().map(|(_, texture)| texture),
            PictureKind::Classes => self.classes.as_ref().map(|(_, texture)| texture),
        }
    }
}

fn texture(ctx: &egui::Context, name: &str, size: [usize; 2], pixels: Vec<Color32>) -> TextureHandle {
    ctx.load_texture(name, ColorImage::new(size, pixels), TextureOptions::NEAREST)
}

/// How a pixel was clicked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelClick {
    /// It is of the class.
    Add,
    /// It is not.
    TakeAway,
}

/// What the pointer does to a picture, at a pixel from the left and from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelPointer {
    /// From the left and from the top.
    pub at: (usize, usize),
    /// Whether it is clicked in this frame.
    pub click: Option<PixelClick>,
}

/// Room between two pictures, in points.
pub const GAP: f32 = 6.0;
/// Height of a picture's title, in points.
pub const TITLE: f32 = 18.0;
/// No pixel is larger than this, in points.
const LARGEST: f32 = 16.0;

/// The size of a pixel with which so many pictures side by side fit into a room, in points: whole from 2 on, since they are seen
/// to be uneven otherwise, and at least 1.
pub fn scale(room: Vec2, (width, height): (usize, usize), count: usize) -> f32 {
    let count = count.max(1) as f32;
    let across = (room.x - (count - 1.0) * GAP) / (count * width.max(1) as f32);
    let fits = across.min((room.y - TITLE) / height.max(1) as f32);
    let even = if fits >= 2.0 { fits.floor() } else { (2.0 * fits).floor() / 2.0 };
    even.clamp(1.0, LARGEST)
}

/// Shows a picture under its title, and says where the pointer is in it.
pub fn show(
    ui: &mut egui::Ui,
    (kind, title, tip): (PictureKind, &str, &str),
    textures: &PictureTextures,
    (size, scale): ((usize, usize), f32),
    found: &FoundThings,
) -> Option<PixelPointer> {
    let extent = vec2(size.0 as f32, size.1 as f32) * scale;
    ui.allocate_ui(extent + vec2(0.0, TITLE), |ui| {
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            let (head, named) = ui.allocate_exact_size(vec2(extent.x, TITLE), Sense::hover());
            let quiet = colours::egui(colours::QUIET);
            let font = egui::FontId::proportional(SMALL);
            ui.painter().text(head.left_center(), Align2::LEFT_CENTER, title, font, quiet);
            named.on_hover_text(tip);
            let (rect, response) = ui.allocate_exact_size(extent, Sense::click());
            if let Some(texture) = textures.of(kind) {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                ui.painter().image(texture.id(), rect, whole, Color32::WHITE);
            }
            if kind == PictureKind::Blobs {
                let painter = ui.painter_at(rect);
                found.draw(&painter, rect, scale);
            }
            pointer(ui, &response, rect, size)
        })
        .inner
    })
    .inner
}

fn pointer(
    ui: &egui::Ui,
    response: &egui::Response,
    rect: Rect,
    size: (usize, usize),
) -> Option<PixelPointer> {
    let pointed = response.interact_pointer_pos().or(response.hover_pos())?;
    let at = pixel_at(rect, size, pointed)?;
    let alt = ui.input(|input| input.modifiers.alt);
    let click = match (response.clicked(), response.secondary_clicked()) {
        (true, _) if !alt => Some(PixelClick::Add),
        (true, _) | (_, true) => Some(PixelClick::TakeAway),
        (false, false) => None,
    };
    Some(PixelPointer { at, click })
}

/// The pixel at a point of the screen.
fn pixel_at(rect: Rect, (width, height): (usize, usize), at: Pos2) -> Option<(usize, usize)> {
    let share = (at - rect.min) / rect.size();
    let pixel = |share: f32, count: usize| {
        (0.0..1.0).contains(&share).then(|| ((share * count as f32) as usize).min(count - 1))
    };
    Some((pixel(share.x, width)?, pixel(share.y, height)?))
}

/// What is drawn over the picture of blobs.
pub struct FoundThings<'a> {
    /// Patches of one colour.
    pub blobs: &'a [ColourBlob],
    /// What was recognised.
    pub things: &'a [SeenThing],
}

/// A blob of fewer pixels is not drawn unless it was recognised.
const SPECK: usize = 6;

impl FoundThings<'_> {
    fn draw(&self, painter: &egui::Painter, picture: Rect, scale: f32) {
        for blob in self.blobs.iter().filter(|blob| blob.area >= SPECK && blob.class != ColourClass::Green) {
            frame(painter, around(picture, scale, blob.bounds), 1.0, blob.class);
        }
        let placed = |thing: &SeenThing| {
            let [least, most] = thing.corners.map(|corner| picture.min + scale * vec2(corner.x, corner.y));
            Rect::from_min_max(least, most)
        };
        for thing in self.things {
            frame(painter, placed(thing), 2.0, thing.class);
        }
        let mut taken = Vec::new();
        for thing in self.things {
            if let Some(words) = &thing.words {
                taken.push(label(painter, picture, placed(thing), (words, thing.class), &taken));
            }
        }
    }
}

/// Some pixels of a picture on the screen.
fn around(picture: Rect, scale: f32, PixelBox { left, top, right, bottom }: PixelBox) -> Rect {
    let corner = |x: usize, y: usize| picture.min + scale * vec2(x as f32, y as f32);
    Rect::from_min_max(corner(left, top), corner(right + 1, bottom + 1))
}

fn frame(painter: &egui::Painter, around: Rect, width: f32, class: ColourClass) {
    let outside = egui::StrokeKind::Outside;
    painter.rect_stroke(around, 0.0, Stroke::new(width + 2.0, Color32::from_black_alpha(160)), outside);
    painter.rect_stroke(around, 0.0, Stroke::new(width, colours::egui(colours::class(class))), outside);
}

/// Words over a thing, with a stroke in its colour; where that is.
fn label(
    painter: &egui::Painter,
    picture: Rect,
    around: Rect,
    (words, class): (&str, ColourClass),
    taken: &[Rect],
) -> Rect {
    let font = egui::FontId::proportional(SMALL);
    let galley = painter.layout_no_wrap(words.to_owned(), font, colours::egui(colours::TEXT));
    let place = free_place(picture, around, galley.size() + vec2(7.0, 0.0), taken);
    painter.rect_filled(place, 2.0, Color32::from_black_alpha(190));
    let stroke = place.with_max_x(place.left() + 3.0);
    painter.rect_filled(stroke, 1.0, colours::egui(colours::class(class)));
    painter.galley(place.min + vec2(5.0, 0.0), galley, Color32::WHITE);
    place
}

/// A place for a label of a size: over a thing if it is free, else the nearest one above or below that is; within the picture.
fn free_place(picture: Rect, around: Rect, size: Vec2, taken: &[Rect]) -> Rect {
    let left = (around.center().x - size.x / 2.0).min(picture.right() - size.x).max(picture.left());
    let lowest = (picture.bottom() - size.y).max(picture.top());
    let wanted = (around.top() - 2.0 - size.y).clamp(picture.top(), lowest);
    let at = |top: f32| Rect::from_min_size(pos2(left, top), size);
    let is_free = |place: &Rect| !taken.iter().any(|other| overlap(*other, *place));
    let steps = (0..=40).flat_map(|step| [-step, step]).map(|step| wanted + step as f32 * size.y / 2.0);
    let within = steps.filter(|top| (picture.top()..=lowest).contains(top));
    within.map(at).find(is_free).unwrap_or(at(wanted))
}

/// Whether two places have more than an edge in common.
fn overlap(a: Rect, b: Rect) -> bool {
    let common = a.intersect(b);
    common.width() > 0.5 && common.height() > 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: (usize, usize) = (208, 160);

    #[test]
    fn pictures_are_as_large_as_fit_and_their_pixels_even() {
        assert_eq!(scale(vec2(630.0, 400.0), SIZE, 1), 2.0);
        assert_eq!(scale(vec2(630.0, 400.0), SIZE, 3), 1.0);
        assert_eq!(scale(vec2(960.0, 400.0), SIZE, 3), 1.5);
        assert_eq!(scale(vec2(2000.0, 500.0), SIZE, 3), 3.0);
        assert_eq!(scale(vec2(10.0, 10.0), SIZE, 3), 1.0, "smaller rooms scroll");
        assert_eq!(scale(vec2(960.0, 400.0), (52, 40), 3), 6.0, "one of a quarter is as large");
    }

    #[test]
    fn labels_lie_over_their_things_beside_each_other_and_within_the_picture() {
        let picture = Rect::from_min_size(pos2(100.0, 50.0), vec2(240.0, 180.0));
        let thing = Rect::from_min_size(pos2(180.0, 120.0), vec2(20.0, 20.0));
        let mut taken: Vec<Rect> = Vec::new();
        for _ in 0..8 {
            let place = free_place(picture, thing, vec2(90.0, 16.0), &taken);
            assert!(picture.contains_rect(place) && !taken.iter().any(|other| overlap(*other, place)));
            taken.push(place);
        }
        assert_eq!((taken[0].bottom(), taken[0].center().x), (118.0, 190.0));
    }

    #[test]
    fn a_point_is_that_of_the_pixel_under_it_and_none_outside() {
        let rect = Rect::from_min_size(pos2(100.0, 50.0), vec2(416.0, 320.0));
        assert_eq!(pixel_at(rect, SIZE, pos2(100.0, 50.0)), Some((0, 0)));
        assert_eq!(pixel_at(rect, SIZE, pos2(101.9, 52.1)), Some((0, 1)));
        assert_eq!(pixel_at(rect, SIZE, pos2(515.9, 369.9)), Some((207, 159)));
        assert_eq!(pixel_at(rect, SIZE, pos2(516.0, 369.9)), None);
        assert_eq!(pixel_at(rect, SIZE, pos2(99.0, 60.0)), None);
    }
}
