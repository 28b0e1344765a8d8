import { describe, expect, it } from 'vitest';
import type { Sim, State } from '@/generated/messages';
import { doesWorldRunAlone, isWorldPaused } from './clock';

const at = (executor: State, paused: boolean | null = null) => ({
  executor,
  sim: paused === null ? null : ({ paused } as Sim),
});

describe('the clock of the world', () => {
  it.each([
    ['idle', null, false, false],
    ['connected', null, false, false],
    ['visualization_ready', null, true, false],
    ['visualization_ready', true, true, false],
    ['visualization_ready', false, false, true],
    ['application_running', false, false, false],
    ['application_running', true, false, false],
    ['paused', false, true, false],
  ] as const)('in %s with paused %s', (executor, paused, isPaused, isAlone) => {
    expect(isWorldPaused(at(executor, paused))).toBe(isPaused);
    expect(doesWorldRunAlone(at(executor, paused))).toBe(isAlone);
  });
});
