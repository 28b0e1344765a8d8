import { useSource } from '@/store/moment/source';
import { useMoment } from '@/store/moment/store';
import { closePast, openPast, useTabs } from '@/workspace/tabs';

const isShown = () => useMoment.getState().shown !== null;
/** A kept run was opened by the user's wish; on the time axis of the present one the document stays. */
const open = () => openPast(useSource.getState().kept !== null);

/** Opens the tab of the tree as it ran while the user looks back, also in a new layout. */
export function followPast(): () => void {
  const stops = [
    useMoment.subscribe((now, before) => {
      if (now.shown && !before.shown) open();
      if (!now.shown && before.shown) closePast();
    }),
    useTabs.subscribe((now, before) => {
      // The documents of a new layout are opened right after it was made.
      if (now.model && now.model !== before.model) queueMicrotask(() => isShown() && open());
    }),
  ];
  return () => stops.forEach((stop) => stop());
}
