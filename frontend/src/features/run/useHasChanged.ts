import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';

/** Returns whether the project was edited since the running program was started. */
export function useHasChanged(): boolean {
  const ranAt = useRunStore((state) => state.ranAt);
  return useProjectStore((state) => state.changeCounter !== ranAt);
}
