import { screen, within } from '@testing-library/react';
import { beforeEach, expect, it } from 'vitest';
import { refusal } from '../../../harness/requests';
import { myRun as run } from '../../../harness/runs';
import { fakeServer, show, user } from '../../../harness/testing';
import { MyRuns } from './MyRuns';

const LIST = 'GET /runs';

beforeEach(() => window.history.pushState(null, '', '/'));

function open(answers: Record<string, unknown>) {
  const { requests } = fakeServer(answers);
  const { container } = show(<MyRuns />);
  return { asked: () => requests.map(({ method, path }) => `${method} ${path}`), container };
}

it('says what will be there', async () => {
  open({ [LIST]: { items: [] } });
  expect(await screen.findByText(/No runs yet/)).toBeInTheDocument();
  expect(screen.queryByRole('list')).toBeNull();
});

it('shows picture, length, result, note and project of a run, and goes to it', async () => {
  const { container } = open({ [LIST]: { items: [run(1, { note: 'It turned too late.' })] } });
  const row = await screen.findByRole('listitem');
  for (const text of ['1:05 min', 'Success', 'It turned too late.', 'Robot'])
    expect(row).toHaveTextContent(text);
  expect(container.querySelector('img')?.getAttribute('src')).toMatch(/p1\/runs\/00000001.*\/thumbnail/);
  await user.click(within(row).getByRole('link', { name: 'Run 1' }));
  expect(window.location.pathname).toBe('/projects/p1');
  expect(window.location.search).toBe('?run=00000001-0000-0000-0000-000000000000');
});

it('shows the rest when it is asked for', async () => {
  open({ [LIST]: { items: [1, 2, 3, 4, 5, 6, 7, 8].map((number) => run(number)) } });
  expect(await screen.findAllByRole('listitem')).toHaveLength(6);
  await user.click(screen.getByRole('button', { name: 'Show 2 more runs' }));
  expect(screen.getAllByRole('listitem')).toHaveLength(8);
});

it('says why there is no list, and asks again', async () => {
  const answers: Record<string, unknown> = { [LIST]: refusal('The database is away.') };
  open(answers);
  expect(await screen.findByRole('alert')).toHaveTextContent('The database is away.');
  answers[LIST] = { items: [run(1)] };
  await user.click(screen.getByRole('button', { name: 'Try again' }));
  expect(await screen.findByRole('listitem')).toHaveTextContent('Run 1');
});

it('makes a project of a log, and goes to it', async () => {
  const { container, asked } = open({
    [LIST]: { items: [] },
    'POST /runs/logs?filename=patrol.btlog': run(3, { project: 'p9' }),
  });
  const input = container.ownerDocument.querySelector('input[type=file]') as HTMLInputElement;
  await user.upload(input, new File(['log'], 'patrol.btlog'));
  await expect.poll(() => window.location.pathname).toBe('/projects/p9');
  expect(asked()).toContain('POST /runs/logs?filename=patrol.btlog');
});

it('says why a log cannot be read', async () => {
  const { container } = open({
    [LIST]: { items: [] },
    'POST /runs/logs?filename=f.btlog': refusal('f.btlog:0: it ends within its head'),
  });
  const input = container.ownerDocument.querySelector('input[type=file]') as HTMLInputElement;
  await user.upload(input, new File(['x'], 'f.btlog'));
  expect(await screen.findByText(/it ends within its head/)).toBeInTheDocument();
  expect(window.location.pathname).toBe('/');
});
