//! The grammar of signatures, each of which is written out where its id is first used.

use super::parser::Parser;
use crate::error::{Damage, Stop};
use crate::format::{limits, tag};
use crate::signature::{
    BitmaskId, BitmaskSignature, EnumId, EnumSignature, FunctionSignature, SignatureId, StructId,
    StructSignature,
};

/// A named value of an enumeration or bitmask.
type Named<T> = (Box<str>, T);

impl Parser {
    #[inline]
    pub(super) fn function(&mut self) -> Result<SignatureId, Stop> {
        let id = self.input.uint()?;
        match self.signatures.functions.find(id) {
            Some(index) => Ok(index.into()),
            None => self.define_function(id),
        }
    }

    #[cold]
    fn define_function(&mut self, id: u64) -> Result<SignatureId, Stop> {
        let name = self.name()?;
        let arg_names = self.member_names()?;
        let table = &mut self.signatures.functions;
        let index = table.items.len().into();
        let signature = FunctionSignature { id: index, name, arg_names };
        table.insert(id, signature);
        Ok(index)
    }

    pub(super) fn structure(&mut self) -> Result<StructId, Stop> {
        let id = self.input.uint()?;
        if let Some(index) = self.signatures.structs.find(id) {
            return Ok(index.into());
        }
        let name = self.name()?;
        let member_names = self.member_names()?;
        let table = &mut self.signatures.structs;
        let index = table.items.len().into();
        let signature = StructSignature { id: index, name, member_names };
        table.insert(id, signature);
        Ok(index)
    }

    pub(super) fn bitmask(&mut self) -> Result<BitmaskId, Stop> {
        let id = self.input.uint()?;
        if let Some(index) = self.signatures.bitmasks.find(id) {
            return Ok(index.into());
        }
        let flags = self.named_values(|parser| parser.input.uint())?;
        let table = &mut self.signatures.bitmasks;
        let index = table.items.len().into();
        table.insert(id, BitmaskSignature { id: index, flags });
        Ok(index)
    }

    #[inline]
    pub(super) fn enumeration(&mut self) -> Result<EnumId, Stop> {
        let id = self.input.uint()?;
        match self.signatures.enums.find(id) {
            Some(index) => Ok(index.into()),
            None => {
                let values = self.named_values(Self::enumerant)?;
                Ok(self.define_enumeration(id, values))
            }
        }
    }

    /// Before version 3 every enumerant was a signature of its own, which also held the value.
    pub(super) fn lone_enumerant(&mut self) -> Result<(EnumId, i64), Stop> {
        let id = self.input.uint()?;
        let index = match self.signatures.enums.find(id) {
            Some(index) => index.into(),
            None => {
                self.claim_names(1)?;
                let enumerant = (self.name()?, self.enumerant()?);
                self.define_enumeration(id, vec![enumerant])
            }
        };
        let value = self.signatures.enumeration(index).values[0].1;
        Ok((index, value))
    }

    #[cold]
    fn define_enumeration(&mut self, id: u64, values: Vec<Named<i64>>) -> EnumId {
        let table = &mut self.signatures.enums;
        let index = table.items.len().into();
        table.insert(id, EnumSignature::new(index, values));
        index
    }

    /// The value of an enumerant: tagged like any value, but always an integer.
    #[inline]
    pub(super) fn enumerant(&mut self) -> Result<i64, Stop> {
        match self.input.byte()? {
            tag::UINT => Ok(self.input.uint()? as i64),
            tag::SINT => self.negative(),
            other => Err(Damage::EnumerantType(other).into()),
        }
    }

    /// A negative integer, which is written as its magnitude.
    pub(super) fn negative(&mut self) -> Result<i64, Stop> {
        Ok((self.input.uint()? as i64).wrapping_neg())
    }

    fn named_values<T>(
        &mut self,
        value: impl Fn(&mut Self) -> Result<T, Stop>,
    ) -> Result<Vec<Named<T>>, Stop> {
        self.claim_names(1)?;
        let count = self.input.uint()?;
        let mut values = Vec::new();
        for _ in 0..count {
            values.push((self.name()?, value(self)?));
        }
        Ok(values)
    }

    fn member_names(&mut self) -> Result<Vec<Box<str>>, Stop> {
        let count = self.input.uint()?;
        if count > limits::ARGUMENTS {
            return Err(Damage::SignatureSize.into());
        }
        (0..count).map(|_| self.name()).collect()
    }

    /// A string of the kind that is kept while the trace is read.
    pub(super) fn name(&mut self) -> Result<Box<str>, Stop> {
        self.claim_names(1)?;
        let length = self.input.uint()?;
        if length > limits::NAME_BYTES {
            return Err(Damage::StringLength(length).into());
        }
        self.name_bytes_left = self.name_bytes_left.checked_sub(length).ok_or(Damage::SignatureSize)?;
        let bytes = self.input.bytes(length as usize)?;
        Ok(String::from_utf8_lossy(&bytes).into())
    }

    pub(super) fn claim_names(&mut self, count: u64) -> Result<(), Stop> {
        self.names_left = self.names_left.checked_sub(count).ok_or(Damage::SignatureSize)?;
        Ok(())
    }
}
