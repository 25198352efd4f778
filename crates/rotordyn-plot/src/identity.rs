//! Identity of the run that a figure shows, as metadata of its files.

/// Bytes of a PNG file before its second chunk: the signature and the header (IHDR).
const PNG_HEADER: usize = 8 + 25;
/// Keyword of the text in PNG files.
const KEYWORD: &str = "Source";

/// The text in both files.
fn text(identity: &str) -> String {
    format!("rotordyn run {identity}")
}

/// An SVG document with an identity in its `<metadata>`.
pub(crate) fn mark_svg(svg: &str, identity: &str) -> String {
    // The first element is `<svg ...>`, and no attribute of it contains `>`.
    let body = svg.find('>').map_or(0, |end| end + 1);
    format!("{}\n<metadata>{}</metadata>{}", &svg[..body], text(identity), &svg[body..])
}

/// A PNG file with an identity in a text chunk behind its header (PNG specification, 11.3.3.2 tEXt).
pub(crate) fn mark_png(png: &[u8], identity: &str) -> Vec<u8> {
    let (header, image) = png.split_at(PNG_HEADER.min(png.len()));
    let content = [b"tEXt", KEYWORD.as_bytes(), &[0], text(identity).as_bytes()].concat();
    let length = (content.len() - 4) as u32;
    let check = crc32fast::hash(&content);
    [header, &length.to_be_bytes(), &content, &check.to_be_bytes(), image].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_svg_document_has_the_identity_before_its_content() {
        let marked =
            mark_svg("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\">\n<rect/></svg>", "0123abcd");
        assert!(
            marked.contains("width=\"4\">\n<metadata>rotordyn run 0123abcd</metadata>\n<rect/>"),
            "{marked}"
        );
    }

    #[test]
    fn a_png_decoder_reads_the_identity_and_the_same_image() {
        let image = [10, 20, 30, 40, 50, 60];
        let mut plain = Vec::new();
        let mut encoder = png::Encoder::new(&mut plain, 2, 3);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().unwrap().write_image_data(&image).unwrap();
        let marked = mark_png(&plain, "0123abcd");
        let mut reader = png::Decoder::new(std::io::Cursor::new(marked)).read_info().unwrap();
        let mut read = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut read).unwrap();
        assert_eq!(read, image);
        let texts = &reader.info().uncompressed_latin1_text;
        assert_eq!((texts.len(), texts[0].keyword.as_str()), (1, "Source"));
        assert_eq!(texts[0].text, "rotordyn run 0123abcd");
    }
}
