import { beforeEach, expect, it } from 'vitest';
import { emptyDiagram } from '@/model/diagram';
import { beginProgram, keepPort, noteRefusal, setTyping, useLivePorts } from './livePorts';

const refusal = { value: 'x', before: '1', code: 'bad_port', message: 'no number' };

beforeEach(() => {
  beginProgram(null);
});

it('knows what was refused until the program takes another text', () => {
  noteRefusal('Main/a', 'speed', refusal);
  noteRefusal('Main/a', 'angle', refusal);
  noteRefusal('Main/a', 'speed', null);
  expect(useLivePorts.getState().refused).toEqual({ 'Main/a': { angle: refusal } });
  const { refused } = useLivePorts.getState();
  noteRefusal('Main/b', 'speed', null);
  expect(useLivePorts.getState().refused).toBe(refused);
});

it('begins a program without what was refused, kept or typed before', () => {
  noteRefusal('Main/a', 'speed', refusal);
  keepPort('Main/a', 'speed', '0.5');
  keepPort('Main/a', 'angle', null);
  expect(useLivePorts.getState().kept).toEqual({ 'Main/a': { speed: '0.5', angle: null } });
  setTyping(true);
  const program = { Main: emptyDiagram('Main') };
  beginProgram(program);
  expect(useLivePorts.getState()).toEqual({
    program,
    isTyping: false,
    refused: {},
    kept: {},
    portsOnlyUntil: -1,
  });
});
