import { Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import type { TryOutcome } from '@/generated/messages';
import { cssOf, hueOf } from '@/store/session/trace/shownPaths';
import { pointsOf, viewOf } from './plan';
import classes from './tries.module.css';

interface TryPlanProps {
  readonly outlines: readonly (readonly [number, number][])[];
  readonly outcomes: readonly TryOutcome[];
}

/** The paths of the robots from above, a colour and a number each, in the world as it stood at the moment. */
export function TryPlan({ outlines, outcomes }: TryPlanProps) {
  const { t } = useTranslation('axis');
  const view = viewOf(outcomes);
  if (view === null) {
    return outcomes.length > 0 ? (
      <Text size="sm" c="dimmed">
        {t('tries.empty')}
      </Text>
    ) : null;
  }
  const [, , width, height] = view;
  const size = Math.max(width, height) / 100;
  return (
    <svg
      className={classes['plan']}
      viewBox={view.join(' ')}
      role="img"
      aria-label={t('tries.plan')}
      data-testid="tries-plan"
    >
      {outlines.map((outline, at) => (
        <polygon key={at} className={classes['outline']} points={pointsOf(outline)} />
      ))}
      {outcomes.map((outcome) => (
        <Paths key={outcome.index} outcome={outcome} size={size} />
      ))}
    </svg>
  );
}

function Paths({ outcome, size }: { readonly outcome: TryOutcome; readonly size: number }) {
  const color = cssOf(hueOf(outcome.index));
  const { crash, index, paths } = outcome;
  return (
    <g stroke={color} strokeWidth={index === 0 ? 1.6 * size : 0.9 * size} fill="none">
      {Object.entries(paths).map(([robot, path]) => {
        const [, x, y] = path.at(-1) ?? [0, 0, 0];
        return (
          <g key={robot}>
            <polyline
              points={pointsOf(path.map(([, px, py]) => [px, py] as const))}
              strokeDasharray={index === 0 ? `${2 * size} ${2 * size}` : undefined}
            />
            <text
              className={classes['number']}
              x={x + 1.2 * size}
              y={-y}
              fontSize={4.5 * size}
              strokeWidth={1.2 * size}
              fill={color}
            >
              {index}
            </text>
          </g>
        );
      })}
      {crash ? (
        <path
          className={classes['bump']}
          strokeWidth={1.2 * size}
          d={`M${crash.x - 2 * size},${-crash.y - 2 * size}l${4 * size},${4 * size}m0,${-4 * size}l${-4 * size},${4 * size}`}
        />
      ) : null}
    </g>
  );
}
