import { ActionIcon, Tooltip } from '@mantine/core';
import { IconMaximize, IconMinimize, IconRobot, IconX, type Icon } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { endPresentation, toggleFullScreen, toggleRobot, usePresentation } from '@/workspace/presentation';
import './presentation.css';
import { usePresentationKeys } from './usePresentationKeys';

interface ToolProps {
  readonly label: string;
  readonly icon: Icon;
  readonly testId: string;
  readonly isOn?: boolean;
  readonly onClick: () => void;
}

function Tool({ label, icon: Symbol, testId, isOn, onClick }: ToolProps) {
  return (
    <Tooltip label={label} position="bottom-end">
      <ActionIcon
        size={32}
        variant={isOn ? 'light' : 'subtle'}
        aria-label={label}
        data-testid={testId}
        onClick={onClick}
        {...(isOn === undefined ? {} : { 'aria-pressed': isOn })}
      >
        <Symbol size={18} aria-hidden="true" />
      </ActionIcon>
    </Tooltip>
  );
}

function useFullScreen(): boolean {
  const [isFull, setFull] = useState(Boolean(document.fullscreenElement));
  useEffect(() => {
    const follow = () => setFull(Boolean(document.fullscreenElement));
    document.addEventListener('fullscreenchange', follow);
    return () => document.removeEventListener('fullscreenchange', follow);
  }, []);
  return isFull;
}

/** The few buttons of a presentation: the robot, the full screen, and the way back. */
export function PresentationBar() {
  const { t } = useTranslation('frame');
  const mode = usePresentation((state) => state.mode);
  const isFull = useFullScreen();
  usePresentationKeys(mode !== 'off');
  if (mode === 'off') return null;
  return (
    <div
      className="presentation-bar"
      role="toolbar"
      aria-label={t('presentation.label')}
      data-testid="presentation"
    >
      <Tool
        label={t('presentation.robot')}
        icon={IconRobot}
        testId="presentation-robot"
        isOn={mode === 'robot'}
        onClick={toggleRobot}
      />
      {document.fullscreenEnabled ? (
        <Tool
          label={t(isFull ? 'presentation.window' : 'presentation.full')}
          icon={isFull ? IconMinimize : IconMaximize}
          testId="presentation-full"
          onClick={() => void toggleFullScreen()}
        />
      ) : null}
      <Tool label={t('presentation.end')} icon={IconX} testId="presentation-end" onClick={endPresentation} />
    </div>
  );
}
