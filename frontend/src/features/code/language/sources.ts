import type { LSPClient } from '@codemirror/lsp-client';

/** Asks the server for the text of a source outside of the project, with this URI. */
export async function textOfSource(client: LSPClient, uri: string): Promise<string> {
  const { text } = await client.request<{ uri: string }, { text: string }>('studio/source', { uri });
  return text;
}
