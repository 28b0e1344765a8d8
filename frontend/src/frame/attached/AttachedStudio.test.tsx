import { act, screen } from '@testing-library/react';
import { afterEach, expect, it } from 'vitest';
import type { Fault } from '@/generated/messages';
import { fakeServer, openSession, show, user } from '../../../harness/testing';
import { navigate, useRoute } from '@/store/route';
import { useSessionStore } from '@/store/session/store';
import { AttachedStudio } from './AttachedStudio';

afterEach(() => navigate('/'));

const session = (state: string) => ({ id: 's1', state, target: 'robot:1667', error: 'It was ended.' });

it('says that a session has ended, and follows the program in another one', async () => {
  fakeServer({
    'GET /sessions/s1': session('ended'),
    'POST /sessions/attached': { ...session('starting'), id: 's2' },
  });
  show(<AttachedStudio sessionId="s1" />);
  expect(await screen.findByText('This session has ended')).toBeInTheDocument();
  expect(screen.getByText('It was ended.')).toBeInTheDocument();
  await user.click(screen.getByTestId('attached-again'));
  await expect.poll(() => useRoute.getState().route).toEqual({ page: 'attached', sessionId: 's2' });
});

it('says that there is no such session', async () => {
  fakeServer({});
  show(<AttachedStudio sessionId="s1" />);
  expect(await screen.findByTestId('attached-problem')).toHaveTextContent('cannot be followed');
});

it('says why a program cannot be followed, and tries again', async () => {
  const executor = await openSession({ state: 'visualization_ready' });
  fakeServer({ 'GET /sessions/s1': new Response(new ReadableStream()) });
  show(<AttachedStudio sessionId="s1" />);
  expect(screen.getByText(/Connecting to/)).toBeInTheDocument();
  const fault = { message: 'No answer.', hint: 'Does the program run?' } as Fault;
  act(() => useSessionStore.setState({ faults: [fault] }));
  expect(screen.getByTestId('attached-problem')).toHaveTextContent('No answer.Does the program run?');
  await user.click(screen.getByTestId('attached-again'));
  await expect.poll(() => executor.sentAs('restart_application')).toEqual([{}]);
});
