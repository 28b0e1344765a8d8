import { create, useStore } from 'zustand';
import { useLiveValues, valuesAt, type LiveValue } from '@/store/session/values/live';
import { useShownValues, type ShownPort } from '@/store/session/values/shown';
import { usePastSession } from './session';
import { useMoment } from './store';

/** The values in blocks at the shown moment. */
const usePastValues = create<{ readonly values: ReadonlyMap<ShownPort, LiveValue> }>(() => ({
  values: new Map(),
}));

const take = () => usePastValues.setState({ values: valuesAt(usePastSession.getState()) });

usePastSession.subscribe(take);
useShownValues.subscribe(take);

/** Returns the value of a port that is shown in its block, at the shown moment. */
export function useShownValue(port: ShownPort, isVisible: boolean): LiveValue | undefined {
  const isBack = useMoment((state) => state.shown !== null);
  return useStore(isBack ? usePastValues : useLiveValues, ({ values }) =>
    isVisible ? values.get(port) : undefined,
  );
}
