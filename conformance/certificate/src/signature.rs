//! Signatures in the format of minisign: Ed25519 over the `BLAKE2b` digest of the whole file, in a file of its own.

use std::fmt;
use std::io::Cursor;

use ct_codecs::{Base64, Decoder as _};
use minisign::{PublicKeyBox, SecretKeyBox, SignatureBox};

/// What the name of a signature has after that of the signed file.
pub const SIGNATURE_SUFFIX: &str = ".minisig";

/// How the encoded key of an encrypted secret key begins: algorithm, scrypt, checksum.
const ENCRYPTED_PREFIX: &str = "RWRTY0Iy";

/// How many characters encode the 64 bytes of a signature of the comment.
const COMMENT_SIGNATURE_LENGTH: usize = 88;

/// The line of a signature that has the signature of its comment, from 0.
const COMMENT_SIGNATURE_LINE: usize = 3;

/// A secret key, ready to sign.
pub struct SigningKey {
    secret: minisign::SecretKey,
    public: minisign::PublicKey,
}

impl fmt::Debug for SigningKey {
    /// Its id alone: the secret goes nowhere.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SigningKey({})", self.id())
    }
}

impl SigningKey {
    /// Whether a password is necessary to read the key file.
    pub fn is_encrypted(text: &str) -> bool {
        text.lines().nth(1).is_some_and(|line| line.starts_with(ENCRYPTED_PREFIX))
    }

    /// Reads a key file of minisign.
    ///
    /// # Errors
    /// It is not one, or the password is wrong; the message follows the name of the file.
    pub fn read(text: &str, password: Option<String>) -> Result<Self, String> {
        let not_a_key =
            |error: minisign::PError| format!("is not a secret key of minisign: {error}");
        let secret = match password {
            Some(password) => {
                let key = SecretKeyBox::from(text.to_owned());
                key.into_secret_key(Some(password)).map_err(not_a_key)?
            }
            None => unencrypted(text)?,
        };
        let public = minisign::PublicKey::from_secret_key(&secret).map_err(not_a_key)?;
        let key = Self { secret, public };
        key.sign("", "").map_err(|why| format!("is not a secret key of minisign: {why}"))?;
        Ok(key)
    }

    /// The id of the key pair, as minisign prints it.
    pub fn id(&self) -> String {
        key_id(self.secret.keynum())
    }

    /// The public key, as `--public-key` and `minisign -P` take it.
    pub fn public_key(&self) -> String {
        self.public.to_base64()
    }

    /// Signs a text. The comment, one line, is signed too.
    ///
    /// # Errors
    /// The system gives no random numbers.
    pub fn sign(&self, text: &str, comment: &str) -> Result<String, String> {
        let untrusted = format!("signature of a Gaugeblock certificate, key {}", self.id());
        let text = Cursor::new(text.as_bytes());
        minisign::sign(Some(&self.public), &self.secret, text, Some(comment), Some(&untrusted))
            .map(SignatureBox::into_string)
            .map_err(|error| error.to_string())
    }
}

/// The secret key of a file without a password. minisign writes no checksum into it, which its library expects there.
fn unencrypted(text: &str) -> Result<minisign::SecretKey, String> {
    let line = text.lines().nth(1).unwrap_or_default();
    let wrong = |why: String| format!("is not a secret key of minisign: {why}");
    let bytes =
        Base64::decode_to_vec(line.trim(), None).map_err(|error| wrong(error.to_string()))?;
    let key = minisign::SecretKey::from_bytes(&bytes).map_err(|error| wrong(error.to_string()))?;
    if key.is_encrypted() { Err(wrong("it is encrypted".to_owned())) } else { Ok(key) }
}

/// A public key, which verifies.
#[derive(Clone, Debug)]
pub struct PublicKey(minisign::PublicKey);

impl PublicKey {
    /// Reads a key file of minisign, or its line that encodes the key.
    ///
    /// # Errors
    /// It is neither.
    pub fn read(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let read = if text.contains('\n') {
            minisign::PublicKey::from_box(PublicKeyBox::from(text.to_owned()))
        } else {
            minisign::PublicKey::from_base64(text)
        };
        read.map(Self).map_err(|error| format!("is not a public key of minisign: {error}"))
    }

    /// The id of the key pair, as minisign prints it.
    pub fn id(&self) -> String {
        key_id(self.0.keynum())
    }

    /// Verifies that a text was signed with the secret key. Returns the signed comment.
    ///
    /// # Errors
    /// It was not, or the signature is not in the format.
    pub fn verify(&self, text: &[u8], signature: &str) -> Result<String, String> {
        let line = signature.lines().nth(COMMENT_SIGNATURE_LINE).unwrap_or_default();
        // The library takes the length for granted.
        if line.trim().len() != COMMENT_SIGNATURE_LENGTH {
            return Err("the signature is not in the format of minisign, or was cut off".to_owned());
        }
        let signature = SignatureBox::from_string(signature)
            .map_err(|error| format!("the signature is not in the format of minisign: {error}"))?;
        if signature.keynum() != self.0.keynum() {
            let signer = key_id(signature.keynum());
            return Err(format!("signed with key {signer}, and the public key is {}", self.id()));
        }
        minisign::verify(&self.0, &signature, Cursor::new(text), true, false, false)
            .map_err(|error| format!("the signature does not fit the file: {error}"))?;
        signature.trusted_comment().map_err(|error| error.to_string())
    }
}

/// The number of a key, as minisign prints it.
fn key_id(number: &[u8]) -> String {
    number.iter().rev().map(|byte| format!("{byte:02X}")).collect()
}

#[cfg(test)]
mod tests {
    use ct_codecs::Encoder as _;
    use minisign::KeyPair;

    use super::*;

    fn key() -> (SigningKey, PublicKey) {
        let pair = KeyPair::generate_unencrypted_keypair().unwrap();
        let text = pair.sk.to_box(None).unwrap().to_string();
        let key = SigningKey::read(&text, None).unwrap();
        let public = PublicKey::read(&key.public_key()).unwrap();
        (key, public)
    }

    #[test]
    fn signature_fits_its_text_and_key_only() {
        let ((key, public), (_, other)) = (key(), key());
        let signature = key.sign("text\n", "a comment").unwrap();
        assert_eq!(public.verify(b"text\n", &signature).unwrap(), "a comment");
        assert_eq!(public.id(), key.id());
        assert!(public.verify(b"text", &signature).unwrap_err().contains("does not fit"));
        assert!(other.verify(b"text\n", &signature).unwrap_err().contains(&key.id()));
        let commented = signature.replace("a comment", "b comment");
        assert!(public.verify(b"text\n", &commented).unwrap_err().contains("omment"));
    }

    #[test]
    fn signature_that_was_cut_off_anywhere_is_refused() {
        let (key, public) = key();
        let signature = key.sign("text", "comment").unwrap();
        for end in 0..signature.trim_end().len() {
            assert!(public.verify(b"text", &signature[..end]).is_err(), "{end}");
        }
        assert!(public.verify(b"text", "untrusted comment: \n\n\n\n").is_err());
    }

    #[test]
    fn key_with_a_password_needs_exactly_this_password() {
        let pair = KeyPair::generate_encrypted_keypair(Some("secret".to_owned())).unwrap();
        let text = pair.sk.to_box(None).unwrap().to_string();
        assert!(SigningKey::is_encrypted(&text));
        let read = |password: Option<&str>| SigningKey::read(&text, password.map(str::to_owned));
        assert!(read(Some("secret")).is_ok());
        assert!(read(Some("other")).unwrap_err().contains("password"));
        assert!(read(None).unwrap_err().contains("encrypted"));
        assert!(SigningKey::read("no key", None).is_err());
        assert!(SigningKey::read("untrusted comment: x\nRWQAAEIy\n", None).is_err());
    }

    #[test]
    fn key_without_a_password_has_a_checksum_or_none() {
        let pair = KeyPair::generate_unencrypted_keypair().unwrap();
        let mut bytes = pair.sk.to_bytes();
        let read = |bytes: &[u8]| {
            let line = Base64::encode_to_string(bytes).unwrap();
            SigningKey::read(&format!("untrusted comment: a key\n{line}\n"), None)
        };
        assert_eq!(read(&bytes).unwrap().public_key(), pair.pk.to_base64());
        let checksum = bytes.len() - 32;
        bytes[checksum..].fill(0);
        assert_eq!(read(&bytes).unwrap().public_key(), pair.pk.to_base64());
        bytes[checksum - 64] ^= 1;
        assert!(read(&bytes).is_err(), "its halves do not belong together");
    }

    #[test]
    fn secret_is_not_in_the_debug_output() {
        let (key, _) = key();
        assert_eq!(format!("{key:?}"), format!("SigningKey({})", key.id()));
    }
}
