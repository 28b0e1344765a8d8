import { IconActivity } from '@tabler/icons-react';
import { useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { useShownValue } from '@/store/moment/values';
import type { ShownPort } from '@/store/session/values/shown';
import { useVisible } from '@/ui/hooks/useVisible';
import { shortValue, SPARK, sparkPoints } from './spark';
import classes from './PortValue.module.css';

interface PortValueProps {
  readonly port: ShownPort;
  /** The text that is shown before the port has a value. */
  readonly text: string;
}

/** The live value of the port's blackboard entry, with a spark line if it is a number. */
export function PortValue({ port, text }: PortValueProps) {
  const { t } = useTranslation('canvas');
  const root = useRef<HTMLSpanElement>(null);
  const isVisible = useVisible(root);
  const live = useShownValue(port, isVisible);
  const short = live && shortValue(live.value);
  return (
    <span
      ref={root}
      className={classes['value']}
      data-testid={`value-${port}`}
      data-valued={live ? '' : undefined}
      title={live ? `${live.key} = ${short}` : t('port.shown')}
    >
      {live ? (
        <>
          {live.samples.length > 1 && (
            <svg
              className={classes['spark']}
              viewBox={`0 0 ${SPARK.width} ${SPARK.height}`}
              preserveAspectRatio="none"
              aria-hidden="true"
            >
              <polyline points={sparkPoints(live.samples)} vectorEffect="non-scaling-stroke" />
            </svg>
          )}
          <span className={classes['text']}>{short}</span>
        </>
      ) : (
        <>
          <IconActivity size={11} stroke={2} aria-hidden="true" />
          <span className={classes['text']}>{text}</span>
        </>
      )}
    </span>
  );
}
