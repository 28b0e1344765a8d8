import { ECHO_HZ, send } from '@/store/session/connection';
import { addEcho, dropEcho } from '@/store/session/topics';

export const refreshTopics = () => send('list_topics', {}).catch(() => undefined);

/** Starts echoing a topic; rejects with the reason if the session cannot. */
export async function listen(topic: string): Promise<void> {
  addEcho(topic);
  try {
    await send('echo_topic', { topic, max_hz: ECHO_HZ });
  } catch (error) {
    dropEcho(topic);
    throw error;
  }
}

/** Shows the messages of a topic of a recording; a session that has this topic echoes it, too. */
export function showRecorded(topic: string): void {
  addEcho(topic);
  send('echo_topic', { topic, max_hz: ECHO_HZ }).catch(() => undefined);
}

export function unlisten(topic: string): void {
  dropEcho(topic);
  send('echo_topic', { topic, max_hz: 0 }).catch(() => undefined);
}

export const describeType = (type: string) => send('describe_type', { type });

export const publish = (topic: string, type: string, message: Record<string, unknown>) =>
  send('publish_topic', { topic, type, message });

export const restartNode = (id: string) => send('restart_node', { id });
