import { useRunStore } from '@/store/run/store';
import { useSessionStore } from '@/store/session/store';
import type { StripMessage } from './messages';

/** Removes a message that the user has read. */
export function dismiss({ kind, fault }: StripMessage): void {
  switch (kind) {
    case 'failure':
      return useRunStore.setState({ failure: null });
    case 'connection':
      return useSessionStore.setState({ connection: 'off' });
    case 'viewer':
      return useRunStore.setState({ readTakeOver: viewerKey() });
    case 'restart':
      return useRunStore.setState(({ ranAt }) => ({ declinedRestart: ranAt }));
    default:
      return useSessionStore.setState(({ faults }) => ({
        faults: fault ? faults.filter((other) => other.message !== fault.message) : faults,
        executorReason: '',
      }));
  }
}

/**
 * Returns a key for the role of this page in its session; when the key changes, the notice about the role is
 * new.
 */
export function viewerKey(): string {
  const { introspection, wasTakenOver } = useSessionStore.getState();
  return `${introspection?.client_id ?? ''} ${wasTakenOver}`;
}
