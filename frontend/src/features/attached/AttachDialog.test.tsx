import { screen } from '@testing-library/react';
import { beforeEach, expect, it, vi } from 'vitest';
import { fakeServer, show, user } from '../../../harness/testing';
import { navigate, useRoute } from '@/store/route';
import { AttachDialog } from './AttachDialog';

const onClose = vi.fn();
const ATTACH = 'POST /sessions/attached';
const PREPARE = 'POST /sessions/attached/prepare';

beforeEach(() => {
  localStorage.clear();
  navigate('/');
});

async function attachTo(address: string) {
  const field = screen.getByTestId('attach-address');
  await user.clear(field);
  await user.type(field, `${address}{Enter}`);
}

it('attaches to an address, opens the session, and remembers the address', async () => {
  const { requests } = fakeServer({ [ATTACH]: { id: 's1', state: 'starting', target: 'robot:1667' } });
  show(<AttachDialog isOpen onClose={onClose} />);
  await attachTo(' robot ');
  await expect.poll(() => useRoute.getState().route).toEqual({ page: 'attached', sessionId: 's1' });
  expect(requests.find(({ path }) => path === '/sessions/attached')?.body).toEqual({ address: 'robot' });
  expect(onClose).toHaveBeenCalled();
  expect(localStorage.getItem('bts.attach.address')).toBe('robot');
  navigate('/');
});

it('starts the processes of the session while the address is written', async () => {
  const { requests } = fakeServer({ [PREPARE]: new Response(null, { status: 204 }) });
  const { rerender } = show(<AttachDialog isOpen={false} onClose={onClose} />);
  expect(requests).toEqual([]);
  rerender(<AttachDialog isOpen onClose={onClose} />);
  await expect.poll(() => requests.map(({ path }) => path)).toEqual(['/sessions/attached/prepare']);
});

it('loads the page of the session while the address is written, once, and continues without it', async () => {
  fakeServer({ [ATTACH]: { id: 's1', state: 'starting', target: 'robot:1667' } });
  const onOpen = vi.fn(() => Promise.reject(new Error('no network')));
  const { rerender } = show(<AttachDialog isOpen={false} onOpen={onOpen} onClose={onClose} />);
  expect(onOpen).not.toHaveBeenCalled();
  rerender(<AttachDialog isOpen onOpen={onOpen} onClose={onClose} />);
  await attachTo('robot');
  await expect.poll(() => useRoute.getState().route).toEqual({ page: 'attached', sessionId: 's1' });
  expect(onOpen).toHaveBeenCalledTimes(1);
  navigate('/');
});

it('says what is wrong with an address, until it is changed', async () => {
  const detail = "'ipc:' is no program that is reached by TCP.";
  const body = { title: 'No address', status: 400, code: 'bad_address', detail };
  fakeServer({ [ATTACH]: Response.json(body, { status: 400 }) });
  show(<AttachDialog isOpen onClose={onClose} />);
  await attachTo('');
  expect(await screen.findByText(/Write the name/)).toBeInTheDocument();
  await attachTo('ipc:///x');
  expect(await screen.findByText(new RegExp(detail))).toBeInTheDocument();
  await user.type(screen.getByTestId('attach-address'), 'y');
  await expect.poll(() => screen.queryByText(new RegExp(detail))).toBeNull();
});
