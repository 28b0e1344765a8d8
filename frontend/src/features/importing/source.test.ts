import { expect, it } from 'vitest';
import { hasImportable, sourceOfDrop } from './source';

const leaf = (fullPath: string) => ({
  isFile: true,
  isDirectory: false,
  fullPath,
  file: (done: (file: File) => void) => done(new File(['x'], fullPath.split('/').at(-1) ?? '')),
});

/** A folder of a browser: its entries come in portions of one. */
const folder = (fullPath: string, entries: readonly object[]) => ({
  isFile: false,
  isDirectory: true,
  fullPath,
  createReader: () => {
    const left = [...entries];
    return { readEntries: (done: (found: readonly object[]) => void) => done(left.splice(0, 1)) };
  },
});

const transfer = (...entries: readonly object[]) =>
  ({
    items: entries.map((entry) => ({ kind: 'file', webkitGetAsEntry: () => entry })),
    files: [],
  }) as unknown as DataTransfer;

const CART = folder('/cart', [
  folder('/cart/urdf', [leaf('/cart/urdf/cart.xacro'), leaf('/cart/urdf/wheel.stl')]),
  folder('/cart/__pycache__', [leaf('/cart/__pycache__/a.pyc')]),
  leaf('/cart/package.xml'),
]);

it('reads all folders of a drop with their paths', async () => {
  const dropped = transfer(CART);
  expect(hasImportable(dropped)).toBe(true);
  const { name, files } = await sourceOfDrop(dropped, 100);
  expect(name).toBe('cart');
  expect(files.map(({ path }) => path)).toEqual([
    'cart/urdf/cart.xacro',
    'cart/urdf/wheel.stl',
    'cart/package.xml',
  ]);
});

it.each([
  { ...leaf('/cart/a.stl'), file: (_: unknown, fail: () => void) => fail() },
  {
    ...folder('/cart/a.stl', []),
    createReader: () => ({ readEntries: (_: unknown, fail: () => void) => fail() }),
  },
])('says what of a drop cannot be read', async (entry) => {
  const dropped = transfer(folder('/cart', [entry]));
  await expect(sourceOfDrop(dropped, 100)).rejects.toMatchObject({ reason: 'unread', value: 'cart/a.stl' });
});

it('stops soon after the largest number of files', async () => {
  const { files } = await sourceOfDrop(transfer(CART), 1);
  expect(files).toHaveLength(2);
});

it('knows what may be a robot or a world by its name', () => {
  const named = (name: string) => ({ items: [], files: [new File([], name)] }) as unknown as DataTransfer;
  expect(hasImportable(named('house.world'))).toBe(true);
  expect(hasImportable(named('cart.urdf.xacro'))).toBe(true);
  expect(hasImportable(named('holiday.jpg'))).toBe(false);
});
