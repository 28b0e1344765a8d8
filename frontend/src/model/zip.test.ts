import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, it } from 'vitest';
import { crc32, zipDirectory, zipHeader } from './zip';

const READ = `
import json, sys, zipfile
with zipfile.ZipFile(sys.argv[1]) as z:
    assert z.testzip() is None
    print(json.dumps({i.filename: z.read(i).decode() for i in z.infolist()}))
`;

it('makes zips that another program reads', () => {
  const files = { 'cart/urdf/räder.xacro': '<robot name="é"/>', 'cart/empty': '', 'map.yaml': 'a: 1\n' };
  const entries = Object.entries(files).map(([path, text]) => {
    const bytes = new TextEncoder().encode(text);
    return { path, bytes, size: bytes.length, crc: crc32(bytes) };
  });
  const parts = [...entries.flatMap((entry) => [zipHeader(entry), entry.bytes]), ...zipDirectory(entries)];
  const folder = mkdtempSync(join(tmpdir(), 'zip-'));
  try {
    writeFileSync(join(folder, 'a.zip'), Buffer.concat(parts));
    const read = execFileSync('python3', ['-c', READ, join(folder, 'a.zip')], { encoding: 'utf8' });
    expect(JSON.parse(read)).toEqual(files);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

it('has the checksum of the standard', () => {
  expect(crc32(new TextEncoder().encode('123456789'))).toBe(0xcbf43926);
});
