// A ZIP file whose entries are stored as they are. https://pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT

export interface Entry {
  name: string;
  content: Uint8Array;
}

const table = Uint32Array.from({ length: 256 }, (_, value) => {
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value;
});

function checksum(bytes: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = table[(sum ^ byte) & 255] ^ (sum >>> 8);
  return ~sum >>> 0;
}

/** Whole numbers of two or four bytes, the low byte first. */
function numbers(...values: [bytes: 2 | 4, value: number][]): Uint8Array {
  return Uint8Array.from(values.flatMap(([bytes, value]) => Array.from({ length: bytes }, (_, i) => (value >>> (8 * i)) & 255)));
}

const version = 20;
const namesAreUtf8 = 0x800;
const firstDay = 0x21; // 1 January 1980: the files have no date

export function zip(entries: Entry[]): Blob {
  const parts: Uint8Array[] = [];
  const directory: Uint8Array[] = [];
  let offset = 0;
  for (const { name, content } of entries) {
    const nameBytes = new TextEncoder().encode(name);
    const size = content.length;
    const common = numbers(
      [2, version], [2, namesAreUtf8], [2, 0], [2, 0], [2, firstDay], [4, checksum(content)], [4, size], [4, size], [2, nameBytes.length], [2, 0],
    );
    const local = [numbers([4, 0x04034b50]), common, nameBytes, content];
    directory.push(numbers([4, 0x02014b50], [2, version]), common, numbers([2, 0], [2, 0], [2, 0], [4, 0], [4, offset]), nameBytes);
    parts.push(...local);
    offset += local.reduce((sum, part) => sum + part.length, 0);
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const count = entries.length;
  const end = numbers([4, 0x06054b50], [2, 0], [2, 0], [2, count], [2, count], [4, size], [4, offset], [2, 0]);
  return new Blob([...parts, ...directory, end] as BlobPart[], { type: "application/zip" });
}
