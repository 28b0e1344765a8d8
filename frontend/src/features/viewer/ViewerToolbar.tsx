import { ActionIcon, Menu, Tooltip } from '@mantine/core';
import {
  IconCurrentLocation,
  IconDeviceGamepad2,
  IconEye,
  IconFocusCentered,
  IconRulerMeasure,
  IconView360Arrow,
} from '@tabler/icons-react';
import { useEffect, useEffectEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { registerCommands, type UserCommand } from '@/commands/registry';
import { setDriving, useTeleop } from '@/store/run/teleop';
import { useIsBasic } from '@/store/viewMode';
import { setMeasuring, useMeasuring } from './measuring';
import type { ViewOptions } from './viewOptions';
import classes from './viewer.module.css';

interface ViewerToolbarProps {
  readonly options: ViewOptions & { readonly camera: boolean };
  readonly onChange: (part: Partial<ViewOptions>) => void;
}

const SHOWN = ['rays', 'trail', 'grid', 'frames', 'frustum', 'camera'] as const;

export function ViewerToolbar({ options, onChange }: ViewerToolbarProps) {
  const { t } = useTranslation('viewer');
  const isDriving = useTeleop((state) => state.isOn);
  const isMeasuring = useMeasuring((state) => state.isOn);
  const isBasic = useIsBasic();
  useViewerCommands(options, onChange);
  return (
    <div className={classes['toolbar']} role="toolbar" aria-label={t('tools')}>
      {isBasic ? null : (
        <>
          <Menu position="left-start" closeOnItemClick={false}>
            <Tooltip label={t('show')} position="left">
              <Menu.Target>
                <ActionIcon aria-label={t('show')}>
                  <IconEye size={17} />
                </ActionIcon>
              </Menu.Target>
            </Tooltip>
            <Menu.Dropdown>
              {SHOWN.map((key) => (
                <Menu.CheckboxItem
                  key={key}
                  checked={options[key]}
                  onChange={(isShown) => onChange({ [key]: isShown })}
                >
                  {t(key)}
                </Menu.CheckboxItem>
              ))}
            </Menu.Dropdown>
          </Menu>
          <Tool
            label={t('follow')}
            icon={IconCurrentLocation}
            isPressed={options.follow}
            onClick={() => onChange({ follow: !options.follow })}
          />
          <Tool
            label={t('top')}
            icon={IconFocusCentered}
            onClick={() => onChange({ viewpoint: { kind: 'top' }, follow: false })}
          />
          <Tool
            label={t('reset')}
            icon={IconView360Arrow}
            onClick={() => onChange({ viewpoint: { kind: 'default' }, follow: true })}
          />
        </>
      )}
      {isBasic && !isMeasuring ? null : (
        <Tool
          label={t('measure')}
          icon={IconRulerMeasure}
          isPressed={isMeasuring}
          onClick={() => setMeasuring(!isMeasuring)}
        />
      )}
      <Tool
        label={t('drive')}
        icon={IconDeviceGamepad2}
        isPressed={isDriving}
        onClick={() => setDriving(!isDriving)}
      />
    </div>
  );
}

/** Registers the tools of the 3D view as commands while there is a world. */
function useViewerCommands(
  options: ViewerToolbarProps['options'],
  onChange: ViewerToolbarProps['onChange'],
): void {
  const act = useEffectEvent(onChange);
  const toggle = useEffectEvent((key: 'follow' | (typeof SHOWN)[number]) =>
    onChange({ [key]: !options[key] }),
  );
  useEffect(() => {
    const row = (id: string, labelKey: string, icon: typeof IconEye, run: () => void): UserCommand => ({
      id: `view3d.${id}`,
      group: 'view',
      labelKey: `viewer:${labelKey}`,
      icon,
      run,
    });
    return registerCommands([
      row('follow', 'follow', IconCurrentLocation, () => toggle('follow')),
      row('top', 'top', IconFocusCentered, () => act({ viewpoint: { kind: 'top' }, follow: false })),
      row('reset', 'reset', IconView360Arrow, () => act({ viewpoint: { kind: 'default' }, follow: true })),
      row('measure', 'measure', IconRulerMeasure, () => setMeasuring(!useMeasuring.getState().isOn)),
      ...SHOWN.map((key) => row(`show.${key}`, `toggle.${key}`, IconEye, () => toggle(key))),
    ]);
  }, []);
}

interface ToolProps {
  readonly label: string;
  readonly icon: typeof IconEye;
  readonly isPressed?: boolean;
  readonly onClick: () => void;
}

function Tool({ label, icon: Icon, isPressed, onClick }: ToolProps) {
  return (
    <Tooltip label={label} position="left">
      <ActionIcon
        variant={isPressed ? 'light' : 'subtle'}
        color={isPressed ? 'indigo' : 'gray'}
        aria-label={label}
        {...(isPressed === undefined ? {} : { 'aria-pressed': isPressed })}
        onClick={onClick}
      >
        <Icon size={17} />
      </ActionIcon>
    </Tooltip>
  );
}
