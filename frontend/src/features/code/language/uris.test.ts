import { expect, it } from 'vitest';
import { libraryOf, pathOf, uriOf } from './uris';

it('hides the real folder of a project', () => {
  expect(uriOf('actions/Go há.py')).toBe('file:///project/actions/Go%20h%C3%A1.py');
  expect(pathOf('file:///project/actions/Go%20h%C3%A1.py')).toBe('actions/Go há.py');
  expect(pathOf('file:///library/rclpy/node.py')).toBeNull();
});

it('names the file of a library', () => {
  expect(libraryOf('file:///library/rclpy/no%20de.py')).toBe('rclpy/no de.py');
  expect(libraryOf('file:///project/a.py')).toBeNull();
});
