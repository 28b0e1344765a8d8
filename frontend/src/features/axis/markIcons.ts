import {
  IconAlertTriangleFilled,
  IconBugFilled,
  IconCircleCheckFilled,
  IconFlagFilled,
  IconHandFinger,
  IconHandStop,
  IconPlayerRecordFilled,
} from '@tabler/icons-react';
import type { MarkKind } from '@/store/recording/types';

/** The symbols of the marks on the time axis. */
export const MARK_ICONS: Readonly<Record<MarkKind, typeof IconBugFilled>> = {
  fault: IconBugFilled,
  collision: IconAlertTriangleFilled,
  finished: IconCircleCheckFilled,
  flag: IconFlagFilled,
  stopped: IconPlayerRecordFilled,
  held: IconHandStop,
  forced: IconHandFinger,
};
