//! Pictures as files for other programs: PNG and PPM.

use std::path::Path;

use crate::data::DataError;
use crate::vision::Image;

/// How a picture is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PictureFormat {
    Png,
    Ppm,
}

impl PictureFormat {
    /// By the end of a file's name.
    ///
    /// # Errors
    /// If it is another one.
    pub fn of(path: &Path) -> Result<PictureFormat, DataError> {
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        match extension.as_ref().and_then(|extension| extension.to_str()) {
            Some("png") => Ok(PictureFormat::Png),
            Some("ppm") => Ok(PictureFormat::Ppm),
            _ => Err(DataError::new(path, "must end in .png or .ppm")),
        }
    }

    /// The bytes of the file.
    ///
    /// # Errors
    /// If the picture has no pixels.
    pub fn write(self, image: &Image) -> Result<Vec<u8>, String> {
        let rgb: Vec<u8> = image.pixels.iter().flat_map(|pixel| pixel.to_rgb()).collect();
        match self {
            PictureFormat::Ppm => {
                let head = format!("P6\n{} {}\n255\n", image.width, image.height);
                Ok([head.as_bytes(), &rgb].concat())
            }
            PictureFormat::Png => png_of(image, &rgb).map_err(|error| error.to_string()),
        }
    }
}

fn png_of(image: &Image, rgb: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width as u32, image.height as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vision::Yuv;

    fn picture() -> Image {
        let pixels = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255], [0, 0, 0], [90, 90, 90]];
        Image { width: 3, height: 2, pixels: pixels.map(Yuv::from_rgb).into() }
    }

    #[test]
    fn a_ppm_has_its_head_and_three_bytes_a_pixel() {
        let bytes = PictureFormat::Ppm.write(&picture()).unwrap();
        assert_eq!(bytes[..11], *b"P6\n3 2\n255\n");
        assert_eq!(bytes.len(), 11 + 18);
    }

    #[test]
    fn a_png_reads_back_as_the_picture() {
        let bytes = PictureFormat::Png.write(&picture()).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgb).unwrap();
        assert_eq!((info.width, info.height, info.color_type), (3, 2, png::ColorType::Rgb));
        let expected: Vec<u8> = picture().pixels.iter().flat_map(|pixel| pixel.to_rgb()).collect();
        assert_eq!(rgb, expected);
    }

    #[test]
    fn the_name_of_the_file_says_how_it_is_written() {
        assert_eq!(PictureFormat::of(Path::new("a/b.PNG")), Ok(PictureFormat::Png));
        assert_eq!(PictureFormat::of(Path::new("b.ppm")), Ok(PictureFormat::Ppm));
        let error = PictureFormat::of(Path::new("b.jpg")).unwrap_err().to_string();
        assert!(error.contains("b.jpg") && error.contains(".ppm"), "{error}");
    }
}
