import { create } from 'zustand';
import { notifications } from '@mantine/notifications';
import { reasonOf } from '@/api/reason';
import type { Insertion } from '@/model/reuse';
import { planHere, type Delivery } from '@/store/project/bringing';
import { useProjectStore } from '@/store/project';
import { withTexts } from '@/store/saving/large';

/** Files that the user reviews before they are added to the project. */
export interface Arrivals extends Delivery {
  /** The reason why the files are added, which the dialogue's title and button state. */
  readonly act: 'paste' | 'insert';
  /** The name of the project or the behaviour that the files come from. */
  readonly name: string;
  readonly take: (plan: Insertion) => void;
}

/** The state of the dialogue that shows incoming files. */
export const useArrivals = create<{ arrivals: Arrivals | null }>(() => ({ arrivals: null }));

export const closeArrivals = () => useArrivals.setState({ arrivals: null });

/**
 * Adds files to the project. The user reviews them first: pasted files if any of them is new, files of the
 * library if another file has the name of one.
 */
export function bring(arrivals: Arrivals): void {
  const { files } = useProjectStore.getState();
  const large = Object.keys(arrivals.sources).filter((path) => files[path]?.kind === 'large');
  if (large.length === 0) review(arrivals);
  else void withTexts(large).then(() => review(arrivals), tell);
}

function tell(error: unknown): void {
  notifications.show({ color: 'red', message: reasonOf(error) });
}

function review(arrivals: Arrivals): void {
  const plan = planHere(arrivals);
  const asks = plan.arrivals.some(({ state }) =>
    arrivals.act === 'paste' ? state !== 'same' : state === 'rename',
  );
  if (asks) useArrivals.setState({ arrivals });
  else arrivals.take(plan);
}
