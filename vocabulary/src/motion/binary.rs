//! Samples in few bytes.
//!
//! All numbers are little-endian. In order: eight bytes `GBSAMPLE`; version, u16, 0; number of columns, u16; period
//! and resolution, f64; for each column the length of its name, u8, and the name; number of rows, u64; for each row
//! and column a value, f64; a check, u64: FNV-1a with 64 bits over all bytes before it.

use super::samples::{Column, Samples, SamplesError};
use alloc::format;
use alloc::string::{String, ToString as _};
use alloc::vec;
use alloc::vec::Vec;

const MAGIC: &[u8; 8] = b"GBSAMPLE";
const VERSION: u16 = 0;

/// The check of the compact form over the bytes so far: FNV-1a, the offset basis, then for each byte an exclusive or
/// and a product with the prime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplesCheck(u64);

impl Default for SamplesCheck {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl SamplesCheck {
    /// Adds bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0 = bytes
            .iter()
            .fold(self.0, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3));
    }

    /// The last bytes of the form.
    pub fn to_bytes(self) -> [u8; 8] {
        self.0.to_le_bytes()
    }
}

fn check(bytes: &[u8]) -> u64 {
    let mut check = SamplesCheck::default();
    check.add(bytes);
    check.0
}

impl Samples {
    /// The compact form.
    ///
    /// # Panics
    /// Never: there are less than 65,536 different columns, and no name is longer than 255 bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.header_bytes(self.len());
        for value in self.rows().flatten() {
            bytes.extend(value.to_le_bytes());
        }
        let check = check(&bytes);
        bytes.extend(check.to_le_bytes());
        bytes
    }

    /// The bytes before the first of so many rows. The values of the rows follow, and [`SamplesCheck`] over all of it.
    ///
    /// # Panics
    /// Never: there are less than 65,536 different columns, and no name is longer than 255 bytes.
    pub fn header_bytes(&self, rows: usize) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        let columns = u16::try_from(self.columns().len()).expect("columns differ");
        bytes.extend(columns.to_le_bytes());
        bytes.extend(self.period().to_le_bytes());
        bytes.extend(self.resolution().to_le_bytes());
        for column in self.columns() {
            let name = column.to_string();
            bytes.push(u8::try_from(name.len()).expect("names of columns are short"));
            bytes.extend(name.as_bytes());
        }
        bytes.extend((rows as u64).to_le_bytes());
        bytes
    }

    /// Reads the compact form; what `to_bytes` wrote comes back equal.
    ///
    /// # Errors
    /// Not this form or version, cut short, too long, a check that does not fit, or a value that samples cannot have,
    /// with its byte or row. Memory is allocated only for bytes that exist.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SamplesError> {
        let mut reader = Reader { bytes, place: 0 };
        if reader.take::<8>()? != *MAGIC {
            return Err(SamplesError::at("byte 0", "not a file of samples"));
        }
        let version = u16::from_le_bytes(reader.take()?);
        if version != VERSION {
            return Err(SamplesError::at("byte 8", format!("version {version} is not known")));
        }
        let columns = u16::from_le_bytes(reader.take()?);
        let period = f64::from_le_bytes(reader.take()?);
        let resolution = f64::from_le_bytes(reader.take()?);
        let columns = (0..columns).map(|_| reader.column()).collect::<Result<Vec<_>, _>>()?;
        let width = columns.len();
        let mut samples = Self::new(period, resolution, columns)?;
        let rows = u64::from_le_bytes(reader.take()?);
        let body = bytes.len().saturating_sub(reader.place + size_of::<u64>());
        let wanted = usize::try_from(rows).ok().and_then(|rows| rows.checked_mul(8 * width));
        if wanted != Some(body) {
            let message = format!("{rows} rows of {width} columns do not fill {body} bytes");
            return Err(reader.wrong(message));
        }
        let mut row = vec![0.0; width];
        for _ in 0..rows {
            for value in &mut row {
                *value = f64::from_le_bytes(reader.take()?);
            }
            samples.push(&row)?;
        }
        let sum = check(&bytes[..reader.place]);
        let place = reader.place;
        if u64::from_le_bytes(reader.take()?) != sum {
            let message = "the checksum does not match the bytes before it";
            return Err(SamplesError::at(format!("byte {place}"), message));
        }
        Ok(samples)
    }
}

/// Bytes that are read one after the other.
struct Reader<'a> {
    bytes: &'a [u8],
    place: usize,
}

impl Reader<'_> {
    fn wrong(&self, message: impl Into<String>) -> SamplesError {
        SamplesError::at(format!("byte {}", self.place), message)
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], SamplesError> {
        let rest = self.bytes.get(self.place..).unwrap_or_default();
        let Some((taken, _)) = rest.split_first_chunk::<N>() else {
            return Err(self.wrong("the file ends here"));
        };
        self.place += N;
        Ok(*taken)
    }

    fn column(&mut self) -> Result<Column, SamplesError> {
        let [length] = self.take()?;
        let end = self.place + usize::from(length);
        let name =
            self.bytes.get(self.place..end).ok_or_else(|| self.wrong("the file ends here"))?;
        let column = core::str::from_utf8(name).ok().and_then(Column::from_name);
        let column = column.ok_or_else(|| self.wrong("not the name of a column"))?;
        self.place = end;
        Ok(column)
    }
}
