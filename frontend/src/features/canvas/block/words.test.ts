import { expect, it } from 'vitest';
import { wordsOf } from './words';

it.each([
  ['CheckObstacle', ['Check', 'Obstacle']],
  ['move_base', ['move_', 'base']],
  ['ROSTopic2Key', ['ROS', 'Topic2', 'Key']],
  ['go to the dock', ['go ', 'to ', 'the ', 'dock']],
  ['Sequence', ['Sequence']],
  ['GirarÁngulo', ['Girar', 'Ángulo']],
  ['', ['']],
])('the words of %s', (name, words) => {
  expect(wordsOf(name)).toEqual(words);
});
