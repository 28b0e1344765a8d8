import { beforeEach, expect, it, onTestFinished } from 'vitest';
import type { Fault } from '@/generated/messages';
import { useRunStore } from '@/store/run/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { dismiss } from './dismiss';
import type { StripMessage } from './messages';

const message = (more: Partial<StripMessage>): StripMessage => ({
  id: 'x',
  kind: 'fault',
  tone: 'error',
  titleKey: '',
  values: {},
  text: '',
  hint: '',
  link: null,
  canDismiss: true,
  ...more,
});
const fault = (text: string) => ({ kind: 'exception', message: text }) as Fault;

beforeEach(() => {
  onTestFinished(() => useSessionStore.setState(initialSession, true));
});

it('removes one fault, and leaves the others', () => {
  const faults = [fault('a'), fault('b'), fault('a')];
  useSessionStore.setState({ faults });
  dismiss(message({ fault: fault('a') }));
  expect(useSessionStore.getState().faults).toEqual([fault('b')]);
});

it('declines a restart only for this run', () => {
  useRunStore.setState({ ranAt: 7 });
  dismiss(message({ kind: 'restart' }));
  expect(useRunStore.getState().declinedRestart).toBe(7);
});

it('leaves a lost session', () => {
  useSessionStore.setState({ connection: 'lost' });
  dismiss(message({ kind: 'connection' }));
  expect(useSessionStore.getState().connection).toBe('off');
});
