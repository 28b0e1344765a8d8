import { describe, expect, it } from 'vitest';
import { importsName, withName } from './pythonNames';

describe('withName', () => {
  it.each([
    ['class Turn(Behaviour):', 'class Spin(Behaviour):'],
    ['from Turn import Turn', 'from Spin import Spin'],
    ['from actions.Turn import Turn as T', 'from actions.Spin import Spin as T'],
    ['import Turn\nx = Turn.Turn()', 'import Spin\nx = Spin.Spin()'],
    ['TurnLeft = Turns = self.Turn', 'TurnLeft = Turns = self.Turn'],
    ['Turnó = óTurn = 1', 'Turnó = óTurn = 1'],
    [`topic = "/Turn"  # Turn\nTurn()`, `topic = "/Turn"  # Turn\nSpin()`],
    [`"""Turn\n'it's'"""\nTurn`, `"""Turn\n'it's'"""\nSpin`],
    [String.raw`'\'Turn' + Turn`, String.raw`'\'Turn' + Spin`],
  ])('%s', (source, expected) => {
    expect(withName(source, 'Turn', 'Spin')).toBe(expected);
  });
});

describe('importsName', () => {
  it.each([
    ['from Turn import Turn', true],
    ['    from actions import Go, Turn', true],
    ['import actions.Turn', true],
    ['from actions import (\n    Go,\n    Turn,\n)', true],
    ['from actions import (\n    Go,\n)\nTurn()', false],
    ['import TurnLeft  # Turn', false],
    ['Turn = 1', false],
  ])('%s: %s', (source, expected) => {
    expect(importsName(source, 'Turn')).toBe(expected);
  });
});
