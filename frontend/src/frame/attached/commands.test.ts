import { expect, it } from 'vitest';
import { attached, attachedTree } from '../../../harness/attached';
import { fakeServer, openSession } from '../../../harness/testing';
import type { Segment } from '@/generated/messages';
import { useCommandTable } from '@/commands/registry';
import { useRoute } from '@/store/route';
import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import {
  attachAgain,
  attachedTitle,
  canAttachAgain,
  detach,
  registerAttachedCommands,
  saveAsProject,
  setControl,
} from './commands';

it('takes and gives back control, and says what the session refuses', async () => {
  const executor = await openSession();
  executor.emit('attached', attached());
  await setControl(true);
  expect(executor.sentAs('control')).toEqual([{ on: true }]);
  executor.refuse('control', 'The other program did not take it.');
  await setControl(false);
  expect(useRunStore.getState().failure?.message).toBe('The other program did not take it.');
});

it('follows the program again only when nothing follows it', async () => {
  const executor = await openSession();
  expect(canAttachAgain()).toBe(false);
  executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
  expect(canAttachAgain()).toBe(true);
  await attachAgain();
  expect(executor.sentAs('restart_application')).toEqual([{}]);
});

it('makes a project of the tree, and leaves the program alone when it detaches', async () => {
  const executor = await openSession();
  await saveAsProject(); // nothing is known of a tree yet
  executor.emit('attached_tree', attachedTree);
  executor.emit('attached', attached());
  useSessionStore.setState({ segments: [{ run: 'a1' } as Segment] });
  const { requests } = fakeServer({
    'POST /projects/import?filename=Main.xml': { id: 'p9', proposal: null },
    'POST /projects/p9/runs': { id: 'r1' },
  });
  await saveAsProject();
  const kept = { run: 'a1', name: 'Recording of robot:1667', note: '', session: 's1' };
  expect(requests.map(({ path }) => path)).toEqual([
    '/projects/import?filename=Main.xml',
    '/projects/p9/runs',
  ]);
  expect(requests[1]?.body).toEqual(kept);
  expect(useRoute.getState().route).toEqual({ page: 'project', projectId: 'p9' });
  await detach();
  expect(useRoute.getState().route).toEqual({ page: 'start' });
  expect(requests.map(({ method }) => method)).toEqual(['POST', 'POST', 'DELETE']);
});

it('has its commands in the palette while the page is shown', async () => {
  const executor = await openSession();
  const unregister = registerAttachedCommands();
  const { commands } = useCommandTable.getState();
  expect(commands['attached.control']?.enabled?.()).toBe(false);
  executor.emit('attached', attached({ controls: true }));
  expect(commands['attached.control']?.enabled?.()).toBe(true);
  commands['attached.control']?.run();
  await expect.poll(() => executor.sentAs('control')).toEqual([{ on: false }]);
  expect(commands['attached.save']?.enabled?.()).toBe(false);
  unregister();
  expect(attachedTitle('robot:1667')).toContain('robot:1667');
});
