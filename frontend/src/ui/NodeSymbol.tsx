import {
  IconAdjustments,
  IconAlarm,
  IconAlertTriangle,
  IconAntenna,
  IconArrowsSplit2,
  IconBroadcast,
  IconCheck,
  IconClockPause,
  IconCode,
  IconDatabaseEdit,
  IconEraser,
  IconEye,
  IconFilter,
  IconFlask,
  IconHourglassHigh,
  IconInfinity,
  IconListDetails,
  IconNumber1,
  IconPhoneCall,
  IconPlayerPlayFilled,
  IconRefreshAlert,
  IconRepeat,
  IconShieldHalf,
  IconSitemap,
  IconTarget,
  IconVector,
  IconZoomQuestion,
  IconX,
  IconZzz,
  type Icon,
} from '@tabler/icons-react';
import type { Family } from '@/model/vocabulary';

const ARROW = 'M4.5 12h15M13.5 6l6 6-6 6';
const QUESTION = 'M8 8.2C8 6.2 9.8 5 12 5s4 1.2 4 3.2c0 3-4 3-4 6.3M12 18.9v.1';
const PARALLEL = 'M4 8h14M14 4l4 4-4 4M4 16h14M14 12l4 4-4 4';
const NOT = 'M4.5 9.5h15v6';
const RING = 'M20.6 8.2A9.6 9.6 0 0 0 3 9M3.4 15.8A9.6 9.6 0 0 0 21 15M21.4 4.4v4h-4M2.6 19.6v-4h4';
const BRANCH = 'M4 12h5l5-6h6M9 12l5 6h6M17 3l3 3-3 3M17 15l3 3-3 3';

/** Symbols from the literature that icon sets lack, as strokes on a grid of 24. */
const DRAWN: Readonly<Record<string, { path: string; mark?: 'ring' | 'star' | 'dots' }>> = {
  Sequence: { path: ARROW },
  AsyncSequence: { path: ARROW, mark: 'dots' },
  SequenceWithMemory: { path: ARROW, mark: 'star' },
  ReactiveSequence: { path: ARROW, mark: 'ring' },
  Fallback: { path: QUESTION },
  AsyncFallback: { path: QUESTION, mark: 'dots' },
  ReactiveFallback: { path: QUESTION, mark: 'ring' },
  Parallel: { path: PARALLEL },
  ParallelAll: { path: PARALLEL, mark: 'star' },
  IfThenElse: { path: BRANCH },
  WhileDoElse: { path: BRANCH, mark: 'ring' },
  Inverter: { path: NOT },
};

const ICONS: Readonly<Record<string, Icon>> = {
  TryCatch: IconShieldHalf,
  ForceSuccess: IconCheck,
  ForceFailure: IconX,
  Repeat: IconRepeat,
  RetryUntilSuccessful: IconRefreshAlert,
  KeepRunningUntilFailure: IconInfinity,
  RunOnce: IconNumber1,
  Precondition: IconFilter,
  LoopInt: IconListDetails,
  LoopDouble: IconListDetails,
  LoopString: IconListDetails,
  LoopBool: IconListDetails,
  SkipUnlessUpdated: IconZoomQuestion,
  WaitValueUpdate: IconHourglassHigh,
  Delay: IconClockPause,
  Timeout: IconAlarm,
  AlwaysSuccess: IconCheck,
  AlwaysFailure: IconX,
  Script: IconCode,
  ScriptCondition: IconCode,
  SetBlackboard: IconDatabaseEdit,
  UnsetBlackboard: IconEraser,
  WasEntryUpdated: IconZoomQuestion,
  Sleep: IconZzz,
  TestNode: IconFlask,
  RosAction: IconTarget,
  RosService: IconPhoneCall,
  RosPublish: IconBroadcast,
  RosSubscribe: IconAntenna,
  RosParam: IconAdjustments,
  TfLookup: IconVector,
  SubTree: IconSitemap,
};

const FAMILY_ICONS: Readonly<Record<Family, Icon>> = {
  control: IconArrowsSplit2,
  decorator: IconFilter,
  action: IconPlayerPlayFilled,
  condition: IconEye,
  subtree: IconSitemap,
};

function Drawn({ type, size }: { readonly type: string; readonly size: number }) {
  const symbol = DRAWN[type];
  const ring = symbol?.mark === 'ring';
  return (
    <svg
      width={size}
      height={size}
      viewBox="0 0 24 24"
      fill="none"
      stroke="currentColor"
      strokeWidth={2.2}
      strokeLinecap="round"
      strokeLinejoin="round"
      aria-hidden="true"
    >
      {ring && <path d={RING} strokeWidth={1.7} />}
      <path
        d={symbol?.path}
        {...(ring ? { transform: 'translate(5.6 5.6) scale(0.533)', strokeWidth: 3.6 } : {})}
      />
      {symbol?.mark === 'star' && <path d="M20 2v5M17.8 3.2l4.4 2.6M22.2 3.2l-4.4 2.6" strokeWidth={1.4} />}
      {symbol?.mark === 'dots' && <path d="M7 21.5h.1M12 21.5h.1M17 21.5h.1" strokeWidth={2.4} />}
    </svg>
  );
}

interface NodeSymbolProps {
  readonly type: string;
  /** null for an unknown type. */
  readonly family: Family | null;
  readonly size?: number;
}

/** The symbol of a type of node, in the current text colour. */
export function NodeSymbol({ type, family, size = 20 }: NodeSymbolProps) {
  if (DRAWN[type]) return <Drawn type={type} size={size} />;
  const Symbol =
    (type.startsWith('Switch') ? IconArrowsSplit2 : ICONS[type]) ??
    (family === null ? IconAlertTriangle : FAMILY_ICONS[family]);
  return <Symbol size={size} stroke={2} aria-hidden="true" />;
}
