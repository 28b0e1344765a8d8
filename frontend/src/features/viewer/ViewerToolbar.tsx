import { ActionIcon, Tooltip } from '@mantine/core';
import {
  IconCamera,
  IconCurrentLocation,
  IconFocusCentered,
  IconGrid4x4,
  IconRadar2,
  IconRoute,
  IconView360Arrow,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { ViewOptions } from './viewOptions';
import classes from './viewer.module.css';

interface ViewerToolbarProps {
  readonly options: ViewOptions & { readonly camera: boolean };
  readonly onChange: (part: Partial<ViewOptions>) => void;
}

const TOGGLES = [
  { key: 'rays', icon: IconRadar2 },
  { key: 'trail', icon: IconRoute },
  { key: 'grid', icon: IconGrid4x4 },
  { key: 'follow', icon: IconCurrentLocation },
  { key: 'camera', icon: IconCamera },
] as const;

const VIEWPOINTS = [
  { key: 'top', kind: 'top', icon: IconFocusCentered },
  { key: 'reset', kind: 'default', icon: IconView360Arrow },
] as const;

export function ViewerToolbar({ options, onChange }: ViewerToolbarProps) {
  const { t } = useTranslation('viewer');
  return (
    <div className={classes['toolbar']} role="toolbar" aria-label={t('label3d')}>
      {TOGGLES.map(({ key, icon: Icon }) => (
        <Tooltip key={key} label={t(key)} position="left">
          <ActionIcon
            variant={options[key] ? 'light' : 'subtle'}
            color={options[key] ? 'indigo' : 'gray'}
            aria-label={t(key)}
            aria-pressed={options[key]}
            onClick={() => onChange({ [key]: !options[key] })}
          >
            <Icon size={17} />
          </ActionIcon>
        </Tooltip>
      ))}
      {VIEWPOINTS.map(({ key, kind, icon: Icon }) => (
        <Tooltip key={key} label={t(key)} position="left">
          <ActionIcon aria-label={t(key)} onClick={() => onChange({ viewpoint: { kind } })}>
            <Icon size={17} />
          </ActionIcon>
        </Tooltip>
      ))}
    </div>
  );
}
