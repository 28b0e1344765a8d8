import { expect, it } from 'vitest';
import { connectedClient } from '../../../../harness/languageServer';
import { textOfSource } from './sources';
import { sourceUriOf } from './uris';

it('asks the server for a source', async () => {
  const { client, server } = await connectedClient({}, { 'studio/source': { text: 'class Node: ...' } });
  const uri = sourceUriOf('packages/rclpy/node.py');
  expect(await textOfSource(client, uri)).toBe('class Node: ...');
  expect(server.sent('studio/source')).toEqual([{ uri }]);
});
