import { expect, it } from 'vitest';
import { LIMITS } from '@/generated/limits';
import { pack } from './pack';
import { sourceOfFiles } from './source';

const file = (path: string, text: string, size?: number) => {
  const made = new File([text], path.split('/').at(-1) ?? '');
  if (path.includes('/')) Object.defineProperty(made, 'webkitRelativePath', { value: path });
  if (size !== undefined) Object.defineProperty(made, 'size', { value: size });
  return made;
};
const { signal } = new AbortController();

it('sends one file as it is', async () => {
  const robot = file('cart.urdf', '<robot/>');
  expect(await pack(sourceOfFiles([robot]), signal, () => undefined)).toEqual({
    name: 'cart.urdf',
    data: robot,
  });
});

it('packs a folder under its name, without what belongs to tools', async () => {
  const shares: number[] = [];
  const source = sourceOfFiles([
    file('cart/urdf/cart.urdf', '<robot/>'),
    file('cart/.git/config', 'x'),
    file('cart/package.xml', '<package/>'),
  ]);
  const { name, data } = await pack(source, signal, (share) => shares.push(share));
  expect(name).toBe('cart.zip');
  expect(source.files.map(({ path }) => path)).toEqual(['cart/urdf/cart.urdf', 'cart/package.xml']);
  expect(data.size).toBeGreaterThan(18);
  expect(shares.at(-1)).toBe(1);
});

it('refuses what is too large before it reads anything', async () => {
  const large = file('world.zip', '', LIMITS.import_upload_bytes + 1);
  await expect(pack(sourceOfFiles([large]), signal, () => undefined)).rejects.toMatchObject({
    reason: 'bytes',
    value: LIMITS.import_upload_bytes,
  });
  await expect(pack(sourceOfFiles([]), signal, () => undefined)).rejects.toMatchObject({ reason: 'empty' });
});

it('names a file that cannot be read', async () => {
  const gone = file('a/b.stl', 'x');
  gone.arrayBuffer = () => Promise.reject(new Error('NotFoundError'));
  await expect(pack(sourceOfFiles([gone]), signal, () => undefined)).rejects.toMatchObject({
    reason: 'unread',
    value: 'a/b.stl',
  });
});
