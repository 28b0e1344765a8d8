import { expect, it } from 'vitest';
import { nameOf, pathOf, sourceName, sourceOf, sourceUriOf, uriOf } from './uris';

it('the URI of a path is read back as that path', () => {
  for (const path of ['actions/Go.py', 'notes/a b#c%.md']) {
    expect(pathOf(uriOf(path))).toBe(path);
    expect(sourceOf(sourceUriOf(path))).toBe(path);
  }
});

it('a file is of the project or a source', () => {
  expect(pathOf('file:///library/packages/rclpy/node.py')).toBeNull();
  expect(sourceOf('file:///project/a.py')).toBeNull();
  expect(sourceOf('file:///elsewhere/a.py')).toBeNull();
});

it('a source has the name that a reader knows', () => {
  expect(sourceName('packages/rclpy/node.py')).toBe('rclpy/node.py');
  expect(sourceName('python/os.py')).toBe('os.py');
  expect(sourceName(`typeshed/${'0a'.repeat(20)}/stdlib/builtins.pyi`)).toBe('builtins.pyi');
  expect(nameOf('file:///library/python/os.py')).toBe('os.py');
  expect(nameOf('file:///project/actions/Go.py')).toBe('actions/Go.py');
  expect(nameOf('file:///elsewhere/a.py')).toBe('file:///elsewhere/a.py');
});
