import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import type { State } from '@/generated/messages';
import { perform, useCommandTable } from '@/commands/registry';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { show } from '../../../harness/testing';
import { registerTopicCommands } from './commands';
import { ConnectDialog } from './ConnectDialog';
import { closePublish, usePublishing } from './publishing';

const executor = (state: State) => useSessionStore.setState({ executor: state });

beforeEach(() => {
  onTestFinished(registerTopicCommands());
  onTestFinished(() => {
    closePublish();
    useSessionStore.setState(initialSession, true);
  });
});

it.each([
  ['idle', false],
  ['connected', false],
  ['universe_ready', true],
  ['visualization_ready', true],
  ['application_running', true],
  ['paused', true],
] as const)('publishes while the executor is %s: %s', (state, isAllowed) => {
  executor(state);
  perform('run.publish');
  expect(usePublishing.getState().opened).toEqual(isAllowed ? { topic: '', type: '' } : null);
});

it('shows how a terminal is connected, also without a session', () => {
  show(<ConnectDialog />);
  expect(screen.queryByTestId('connect-ros')).toBeNull();
  act(() => perform('run.connectRos'));
  expect(screen.getByTestId('connect-ros')).toBeInTheDocument();
  expect(screen.queryByTestId('ros-environment')).toBeNull();
});

it('have labels in the palette', () => {
  const { commands } = useCommandTable.getState();
  expect(commands['run.connectRos']).toMatchObject({ group: 'run', labelKey: 'topics:command.connect' });
  expect(commands['run.publish']).toMatchObject({ group: 'run', labelKey: 'topics:command.publish' });
});
