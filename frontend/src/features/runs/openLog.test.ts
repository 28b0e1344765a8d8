import { QueryClient } from '@tanstack/react-query';
import { expect, it, onTestFinished, vi } from 'vitest';
import { useRunsDialog } from '@/store/dialogs/runs';
import { lookNow, setEngineLink } from '@/store/moment/looking';
import { useSource } from '@/store/moment/source';
import { fakeServer } from '../../../harness/testing';
import { openLog } from './openLog';

const POST = 'POST /projects/p1/runs/logs?filename=patrol.btlog';
const t = ((key: string) => key) as unknown as Parameters<typeof openLog>[3];

it('sends the file as it is, and opens what was kept on the axis', async () => {
  setEngineLink(() => ({ post: vi.fn(), onMessage: () => undefined }));
  onTestFinished(() => lookNow());
  const { requests } = fakeServer({
    [POST]: { id: 'r1', name: 'patrol.btlog', start_s: 0, length_s: 5, size: 100 },
  });
  useRunsDialog.setState({ isOpen: true });
  await openLog('p1', new File(['log'], 'patrol.btlog'), new QueryClient(), t);
  expect(requests.map(({ method, path }) => `${method} ${path}`)).toContain(POST);
  expect(useSource.getState().kept).toMatchObject({ id: 'r1', name: 'patrol.btlog' });
  expect(useRunsDialog.getState().isOpen).toBe(false);
});
