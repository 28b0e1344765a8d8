import type { LaunchNode, TopicMismatch } from '@/generated/messages';

interface Sources {
  readonly files: Readonly<Record<string, { readonly text?: string | null }>>;
  readonly launchNodes: readonly LaunchNode[];
}

interface Place {
  readonly file: string;
  readonly line: number;
}

const escaped = (text: string): string => text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');

/** Returns the first line of a Python file that names the topic, with or without its slash. */
function lineIn(text: string, topic: string): number {
  const name = new RegExp(`(["'])/?${escaped(topic.replace(/^\//, ''))}\\1`);
  return text.split('\n').findIndex((line) => name.test(line)) + 1;
}

/**
 * Returns the place where a mismatch of a topic can be repaired: a line of Python that names the topic, or a
 * node of a launch file.
 */
export function placeOfTopic(mismatch: TopicMismatch, { files, launchNodes }: Sources): Place | null {
  for (const [file, { text }] of Object.entries(files)) {
    const line = file.endsWith('.py') && text ? lineIn(text, mismatch.topic) : 0;
    if (line > 0) return { file, line };
  }
  const ends = [mismatch.publisher, mismatch.subscriber];
  const node = launchNodes.find(
    ({ name, file }) => file in files && ends.some((end) => end.endsWith(`/${name}`)),
  );
  return node ? { file: node.file, line: node.line } : null;
}
