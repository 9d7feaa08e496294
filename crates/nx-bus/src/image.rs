//! Process images between two threads: wait-free on both sides, always consistent.

/// A process image and its header.
#[derive(Clone, Debug)]
pub struct ProcessImage<H> {
    /// The information sent with the data.
    pub header: H,
    bytes: Vec<u8>,
}

impl<H: Clone + Send> ProcessImage<H> {
    /// Two ends of an image of `size_bytes` zeros. All the memory that they ever use is allocated here.
    #[must_use]
    pub fn split(header: H, size_bytes: usize) -> (ProcessImageWriter<H>, ProcessImageReader<H>) {
        let (input, output) = triple_buffer::triple_buffer(&Self { header, bytes: vec![0; size_bytes] });
        (ProcessImageWriter(input), ProcessImageReader(output))
    }

    /// The data, with the length of the image.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

/// The end that writes an image.
#[derive(Debug)]
pub struct ProcessImageWriter<H: Send>(triple_buffer::Input<ProcessImage<H>>);

impl<H: Send> ProcessImageWriter<H> {
    /// Publishes a complete image. Excess bytes of `bytes` are ignored, missing bytes keep an older value: both
    /// ends are made for one size.
    pub fn publish(&mut self, header: H, bytes: &[u8]) {
        let image = self.0.input_buffer_mut();
        image.header = header;
        let length_bytes = image.bytes.len().min(bytes.len());
        image.bytes[..length_bytes].copy_from_slice(&bytes[..length_bytes]);
        self.0.publish();
    }
}

/// The end that reads an image.
#[derive(Debug)]
pub struct ProcessImageReader<H: Send>(triple_buffer::Output<ProcessImage<H>>);

impl<H: Send> ProcessImageReader<H> {
    /// The newest complete image; the initial one if none has been published yet.
    pub fn newest(&mut self) -> &ProcessImage<H> {
        self.0.read()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reader_gets_the_newest_whole_image() {
        let (mut writer, mut reader) = ProcessImage::split(0, 4);
        assert_eq!((reader.newest().header, reader.newest().bytes()), (0, &[0; 4][..]));
        for generation in 1..=5u8 {
            writer.publish(i32::from(generation), &[generation; 4]);
        }
        assert_eq!((reader.newest().header, reader.newest().bytes()), (5, &[5; 4][..]));
        assert_eq!(reader.newest().header, 5, "without a new image the last one stays");
    }

    #[test]
    fn an_image_is_never_torn_between_threads() {
        let (mut writer, mut reader) = ProcessImage::split(0u8, 1200);
        let writing = std::thread::spawn(move || {
            for generation in 0..20_000u32 {
                let value = (generation % 251) as u8;
                writer.publish(value, &[value; 1200]);
            }
        });
        while !writing.is_finished() {
            let image = reader.newest();
            assert!(image.bytes().iter().all(|&byte| byte == image.header));
        }
        writing.join().expect("the writer ends");
    }
}
